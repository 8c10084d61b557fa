#pragma once
/** @file
How many persons and trials show a difference: the power of a t test of persons' means, two-sided at
0.05, and the precision of its interval.

    within persons   persons' differences of two conditions, SD^2 = person_sd^2 + 2 trial_sd^2 / k
    between groups   persons' means of k trials,             SD^2 = person_sd^2 + trial_sd^2 / k

with k trials a person and condition. person_sd is of the persons' true differences or of their true
means. The simulation makes normal persons and tests them as a study would (paired t, Welch); the
closed form is the noncentral t distribution. Skewed trials need more. */

#include <string>

#include "core/statistics/answer.h"
#include "core/statistics/proportion.h"

namespace graspbench {

struct PowerDesign {
  bool is_between = false;  ///< two groups instead of two conditions
  double difference = 0.0;  ///< to be shown, > 0
  double trial_sd = 0.0;    ///< within a person and condition, >= 0
  double person_sd = 0.0;   ///< see above, >= 0
};

struct PowerEstimate {
  double power = 0.0;
  Interval interval;        ///< 95 %, of the simulation
  double half_width = 0.0;  ///< of the difference's 95 % interval, in the mean
};

/** Standard deviation of one person's number in the test. */
double CalcPersonSpread(const PowerDesign& design, int num_trials);

/** @param num_persons  2 or more; of each group, where there are groups.
@param id  of the random stream: same id, same answer.
@pre one of the spreads is above 0. */
PowerEstimate SimulatePower(const PowerDesign& design, int num_persons, int num_trials,
                            int num_simulations, const std::string& id);

/** Closed form. */
double CalcPower(const PowerDesign& design, int num_persons, int num_trials);

/** Fewest persons whose power is as wanted. No answer above 1000.
@pre 0 < wanted < 1, one of the spreads is above 0. */
Answer<int> FindPersons(const PowerDesign& design, int num_trials, double wanted);

}  // namespace graspbench
