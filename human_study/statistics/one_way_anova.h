#pragma once
/** @file
One-way analysis of variance of groups of values, which may differ in size: how much groups
(persons) differ beyond the spread of values (trials) within them.

    F = (SS_between / (g - 1)) / (SS_within / (N - g)) */

#include <vector>

#include "core/statistics/answer.h"

namespace graspbench {

struct OneWayAnova {
  int num_groups = 0;
  int num_values = 0;
  double ss_between = 0.0;
  double ss_within = 0.0;
  double df_between = 0.0;
  double df_within = 0.0;
  double ms_between = 0.0;
  double ms_within = 0.0;  ///< > 0
  double f = 0.0;
  double p = 1.0;
};

/** Empty groups do not count. No answer below two groups, when no group has two values, when the
values of every group are equal, or with a value that is not finite. */
Answer<OneWayAnova> CalcOneWayAnova(const std::vector<std::vector<double>>& groups);

/** The same without p, which stays 1: for who asks thousands of times and only needs the rest. */
Answer<OneWayAnova> CalcMeanSquares(const std::vector<std::vector<double>>& groups);

}  // namespace graspbench
