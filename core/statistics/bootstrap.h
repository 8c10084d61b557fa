#pragma once
/** @file
Confidence intervals of any statistic by resampling the members of a group with replacement. The
members must be independent: persons or conditions, not their trials.

The limits are bias-corrected and accelerated (BCa; B. Efron, J. Am. Stat. Assoc. 82 (1987)):

    alpha = Phi(z0 + (z0 + z) / (1 - a (z0 + z))),

where z0 follows from the share of resamples below the estimate (ties count half) and a from the
jackknife. */

#include <functional>
#include <string>
#include <vector>

#include "core/statistics/answer.h"
#include "core/statistics/proportion.h"

namespace graspbench {

struct BootstrapInterval {
  double estimate = 0.0;         ///< of the original group
  Interval interval;             ///< 95 %
  double bias_correction = 0.0;  ///< z0
  double acceleration = 0.0;     ///< a
  int num_resamples = 0;
};

/** The statistic of a group, given by its members' indices; a member may occur several times. NaN:
the statistic is undefined for this group. */
using GroupStatistic = std::function<double(const std::vector<size_t>& members)>;

/** Computes the BCa interval. No answer below five members (too few different resamples), if the
statistic is undefined for some resample, or if it does not vary.
@param id  names the random stream: the same id gives the same interval everywhere.
@pre num_resamples >= 100; limits are stable in the third digit from about 10,000. */
Answer<BootstrapInterval> CalcBootstrap(size_t num_members, const GroupStatistic& statistic,
                                        const std::string& id, int num_resamples = 9999);

/** Standard error, interval and p value of any statistic of a group by the jackknife, which leaves
out each member in turn (J. W. Tukey, Ann. Math. Stat. 29 (1958)):

    SE^2 = (n - 1) / n sum (theta_(i) - mean theta_(.))^2,    theta -+ t_(n-1) SE

For the mean this is exactly Student's t. The statistic must be smooth and approximately normal on
its scale: take the logarithm of ratios and of variances. Members must be independent. */
struct JackknifeInterval {
  double estimate = 0.0;  ///< of the original group, not corrected for bias
  double standard_error = 0.0;
  Interval interval;  ///< 95 %
  double p = 1.0;     ///< two-sided, of a true value of zero
};

/** Computes the jackknife. No answer below three members, if the statistic is undefined for some
group, or if it does not depend on which member is left out. */
Answer<JackknifeInterval> CalcJackknife(size_t num_members, const GroupStatistic& statistic);

}  // namespace graspbench
