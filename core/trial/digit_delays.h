#pragma once
/** @file
When digits close: one later than the others, or all so that they touch in a given order.

A trial in which one digit closes later, towards the same target, shows what a lack of simultaneity
does when nothing else differs. With t0 the start of closure and T the closure time, the digit's
joints are asked for

    q(t) = q_pre + s (q_target - q_pre),   s = clamp((t - t0 - delay) / T, 0, 1)

instead of the same without the delay (strategy.h). The phases go on as the strategy decides: a
digit that is late beyond the strategy's patience still closes during stabilisation. */

#include <map>
#include <string>

#include "core/grasp/closing_law.h"
#include "core/trial/trial_result.h"
#include "core/trial/trial_runner.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

/** The digit that touched first or last in a trial without delay; null where fewer than two touched
or closure did not begin: then there is nothing to delay. @pre the result has its snapshots. */
const DigitContact* FindLateDigit(const TrialResult& undelayed, LateDigit which);

/** The setup with the lateness that `setup.late` and `setup.delay` ask for: of the digit that
touched first or last in the same trial without delay. Without lateness where fewer than two digits
touched or closure did not begin. @param undelayed  the result of that trial, with its snapshots. */
TrialSetup DelayLateDigit(TrialSetup setup, const TrialResult& undelayed);

/** @param digit  index into Hand::digits.
@param delay  >= 0 [s], rounded to whole steps. */
TrialSetup DelayDigit(TrialSetup setup, int digit, double delay);

/** Each digit's delay, less the least of them, as its closing schedule; without those of none. */
std::map<std::string, ClosingSchedule> DelayBy(const std::map<std::string, double>& delays);

/** Closing schedules with which the digits of a grasp touch an object one after the other as asked:
with L_d the asked lag of digit d after the first and t_d its first touch in a trial without
variation,

    delay_d <- delay_d + L_d - (t_d - min t),   then less the least of them

again until every lag is right within a step, for a digit that comes late may find the object
elsewhere; half of the correction, a quarter .. where the whole made it worse, 16 trials at most.
Proposed by graspbench. */
struct LaggedClosing {
  std::map<std::string, ClosingSchedule> closing;  ///< without digits that need none
  double largest_error = 0.0;  ///< of a lag, with that closing [s]; NaN: no such closing was found
  std::string untouching;      ///< then: a digit that did not touch; empty: the simulation failed
};

/** @param setup  of the undelayed trial; a closing schedule of its grasp is not looked at.
@param lags  of each digit of the grasp [s], the least 0. */
LaggedClosing FitContactLags(TrialRunner& runner, TrialSetup setup,
                             const std::map<std::string, double>& lags);

}  // namespace graspbench
