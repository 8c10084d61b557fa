#pragma once
/** @file
Closing schedules with which the digits of a grasp touch an object one after the other as asked:
with L_d the asked lag of digit d after the first and t_d its first touch in a trial without
variation,

    delay_d <- delay_d + L_d - (t_d - min t),   then less the least of them

again until every lag is right within a step, for a digit that comes late may find the object
elsewhere; half of the correction, a quarter .. where the whole made it worse, 16 trials at most.
Proposed by graspbench. */

#include <map>
#include <string>

#include "core/grasp/closing_law.h"
#include "core/trial/trial_runner.h"

namespace graspbench {

/** Each digit's delay, less the least of them, as its closing schedule; without those of none. */
std::map<std::string, ClosingSchedule> DelayBy(const std::map<std::string, double>& delays);

struct LaggedClosing {
  std::map<std::string, ClosingSchedule> closing;  ///< without digits that need none
  double largest_error = 0.0;  ///< of a lag, with that closing [s]; NaN: no such closing was found
  std::string untouching;      ///< then: a digit that did not touch; empty: the simulation gave up
};

/** @param setup  of the undelayed trial; a closing schedule of its grasp is not looked at.
@param lags  of each digit of the grasp [s], the least 0. */
LaggedClosing FitContactLags(TrialRunner& runner, TrialSetup setup,
                             const std::map<std::string, double>& lags);

}  // namespace graspbench
