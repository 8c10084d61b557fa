#pragma once
/** @file
Intervals of any statistic by drawing members of a group with replacement. The members must be
independent: persons, not their trials; cells, not their trials.

The limits are bias-corrected and accelerated (BCa; B. Efron, J. Am. Stat. Assoc. 82 (1987)):

    alpha = Phi(z0 + (z0 + z) / (1 - a (z0 + z))),

z0 from the share of resamples below the estimate (ties count half), a from the jackknife. */

#include <functional>
#include <string>
#include <vector>

#include "core/statistics/answer.h"
#include "core/statistics/proportion.h"

namespace graspbench {

struct BootstrapInterval {
  double estimate = 0.0;         ///< of the group as it is
  Interval interval;             ///< 95 %
  double bias_correction = 0.0;  ///< z0
  double acceleration = 0.0;     ///< a
  int num_resamples = 0;
};

/** The statistic of a group, given by its members' indices; a member may occur several times. NaN
means that this group has none. */
using GroupStatistic = std::function<double(const std::vector<size_t>& members)>;

/** @param id  names the random stream: the same id gives the same interval everywhere.
No answer below five members (too few different resamples), when the statistic has no value for some
resample, or when it does not vary.
@pre num_resamples >= 100; limits are steady in the third digit from about 10,000. */
Answer<BootstrapInterval> CalcBootstrap(size_t num_members, const GroupStatistic& statistic,
                                        const std::string& id, int num_resamples = 9999);

}  // namespace graspbench
