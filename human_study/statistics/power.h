#pragma once
/** @file
Numbers of persons and trials needed to show a difference: the power of a two-sided t test of
persons' means at the 0.05 level, and the precision of its interval.

    within persons   persons' differences of two conditions, SD^2 = person_sd^2 + 2 trial_sd^2 / k
    between groups   persons' means of k trials,             SD^2 = person_sd^2 + trial_sd^2 / k

with k trials per person and condition. person_sd is the SD of the persons' true differences or true
means. The simulation draws normally distributed persons and tests them as a study would (paired t,
Welch); the closed form is the noncentral t distribution. Skewed trials need larger numbers. */

#include <string>

#include "core/statistics/answer.h"
#include "core/statistics/proportion.h"

namespace graspbench {

struct PowerDesign {
  bool is_between = false;  ///< two groups instead of two conditions
  double difference = 0.0;  ///< to be detected, > 0
  double trial_sd = 0.0;    ///< within a person and condition, >= 0
  double person_sd = 0.0;   ///< see above, >= 0
};

struct PowerEstimate {
  double power = 0.0;
  Interval interval;        ///< 95 %, of the simulation
  double half_width = 0.0;  ///< mean half-width of the difference's 95 % interval
};

/** Standard deviation of one person's value in the test. */
double CalcPersonSpread(const PowerDesign& design, int num_trials);

/** Simulates the power. @param num_persons  2 or more; per group if there are groups.
@param id  of the random stream: equal ids give equal results.
@pre trial_sd or person_sd is above 0. */
PowerEstimate SimulatePower(const PowerDesign& design, int num_persons, int num_trials,
                            int num_simulations, const std::string& id);

/** Computes the power in closed form. */
double CalcPower(const PowerDesign& design, int num_persons, int num_trials);

/** Finds the smallest number of persons with the wanted power. No answer above 1000.
@pre 0 < wanted < 1; trial_sd or person_sd is above 0. */
Answer<int> FindPersons(const PowerDesign& design, int num_trials, double wanted);

}  // namespace graspbench
