#pragma once
/** @file
Effect of one factor's levels on a measure by person: the values of a figure, and the difference
between the first and the last level with its interval. */

#include <string>
#include <vector>

#include "core/statistics/answer.h"
#include "core/statistics/proportion.h"
#include "human_study/statistics/condition_means.h"

namespace graspbench {

/** The last level minus the first: a paired t test, or Welch's between groups of persons. */
struct ContrastTest {
  double difference = 0.0;  ///< in the measure's SI unit, as `interval`
  Interval interval;        ///< 95 %
  double p = 1.0;
  int num_first = 0, num_last = 0;  ///< persons; equal for a factor within persons
};

struct PersonContrast {
  Factor factor;
  bool is_between = false;  ///< each person has one level
  std::vector<std::string> persons;
  std::vector<std::vector<double>> values;  ///< [level][person], SI; NaN: none
  std::vector<double> means;                ///< over the persons of each level; NaN: none
  Answer<ContrastTest> test = NoAnswer{"not calculated"};
};

/** Computes the contrast of the first factor, with each person's mean over the levels of the
others; without factors, that of the first group. No answer without either, or with one level. */
Answer<PersonContrast> CalcPersonContrast(const CellMeans& cells);

}  // namespace graspbench
