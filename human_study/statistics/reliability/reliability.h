#pragma once
/** @file
How far one trial of a measure can be trusted, from repeated trials of several persons in one
condition.

With s_w^2 the mean square within persons:
- within-person standard deviation s_w; it is also the standard error of measurement (SEM) of a
  single trial; SEM / sqrt(k) for the mean of k;
- minimal detectable change z sqrt(2) SEM with z = 1.959964, the normal quantile at 0.975: two
single trials that differ by less may be equal (J. P. Weir, J. Strength Cond. Res. 19 (2005));
- trials needed for the mean of k to reach a wanted ICC (Spearman and Brown, 1910):
  k = wanted (1 - ICC(1,1)) / (ICC(1,1) (1 - wanted)), rounded up.

Practice and fatigue over trials count as variation within the person. */

#include <string>
#include <vector>

#include "human_study/statistics/reliability/icc.h"

namespace graspbench {

struct TrialsNeeded {
  double wanted_icc = 0.9;
  int num_trials = 0;
  int fewest = 0;    ///< at the upper limit of the ICC's interval
  Answer<int> most;  ///< at the lower limit; none when that is not positive
};

struct Reliability {
  int num_persons = 0;  ///< with a value
  int num_values = 0;
  int num_missing = 0;
  double mean = 0.0;  ///< over persons, of their means
  double within_person_sd = 0.0;
  Interval within_person_interval;  ///< 95 %
  double between_person_sd = 0.0;   ///< of true values; 0 when the estimated variance is negative
  double minimal_detectable_change = 0.0;
  Answer<IccPair> one_way, agreement, consistency;
  Answer<TrialsNeeded> trials_needed;
};

/** z sqrt(2) of the within-person standard deviation, see above. */
double CalcMinimalDetectableChange(double within_person_sd);

/** No answer below two persons, without a person with two trials, when trials of a person never
differ, or with an infinite value. @pre 0 < wanted_icc < 1. */
Answer<Reliability> CalcReliability(const std::vector<PersonTrials>& persons,
                                    double wanted_icc = 0.9);

/** No answer unless the ICC is positive. @pre single.num_trials == 1, 0 < wanted_icc < 1. */
Answer<TrialsNeeded> CalcTrialsNeeded(const Icc& single, double wanted_icc);

}  // namespace graspbench
