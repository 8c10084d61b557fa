#pragma once
/** @file
Standard error, interval and p value of any statistic of a group by leaving out each member in turn
(J. W. Tukey, Ann. Math. Stat. 29 (1958)):

    SE^2 = (n - 1) / n sum (theta_(i) - mean theta_(.))^2,    theta -+ t_(n-1) SE

For the mean this is Student's t exactly. The statistic must be smooth, and near normal on the scale
it is given on: take the logarithm of ratios and of variances. Members must be independent. */

#include "core/statistics/bootstrap.h"

namespace graspbench {

struct JackknifeInterval {
  double estimate = 0.0;  ///< of the group as it is, not corrected for bias
  double standard_error = 0.0;
  Interval interval;  ///< 95 %
  double p = 1.0;     ///< two-sided, of a true value of zero
};

/** No answer below three members, when the statistic has no value for some group, or when it does
not depend on who is left out. */
Answer<JackknifeInterval> CalcJackknife(size_t num_members, const GroupStatistic& statistic);

/** What the statistic is without each member in turn. No answer when one of them has no value, or
when they do not vary. */
Answer<std::vector<double>> LeaveOneOut(size_t num_members, const GroupStatistic& statistic);

}  // namespace graspbench
