#pragma once
/** @file
Timing of the closing digits: one digit is delayed, or all close so that they touch in a given
order.

A trial in which one digit closes later towards the same target shows the effect of a lack of
simultaneity when nothing else differs. With t0 the start of closure and T the closure time, the
setpoints of the digit's joints are

    q(t) = q_pre + s (q_target - q_pre),   s = clamp((t - t0 - delay) / T, 0, 1)

instead of the same without the delay (strategy.h). The phases proceed as the strategy decides: a
digit whose delay exceeds the strategy's patience still closes during stabilisation. */

#include <map>
#include <string>

#include "core/grasp/closing_law.h"
#include "core/trial/trial_result.h"
#include "core/trial/trial_runner.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

/** Returns the digit that touched first or last in a trial without delay. Returns null if fewer
than two touched or closure did not begin, so that there is nothing to delay. @pre the result has
its snapshots. */
const DigitContact* FindLateDigit(const TrialResult& undelayed, LateDigit which);

/** Returns the setup with `setup.delay` for the digit that `setup.late` selects: the one that
touched first or last in the same trial without delay. There is no delay if fewer than two digits
touched or closure did not begin. @param undelayed  the result of that trial, with its snapshots. */
TrialSetup DelayLateDigit(TrialSetup setup, const TrialResult& undelayed);

/** @param digit  index into Hand::digits.
@param delay  >= 0 [s], rounded to whole steps. */
TrialSetup DelayDigit(TrialSetup setup, int digit, double delay);

/** Converts delays by digit to closing schedules, relative to the least; digits without delay are
omitted. */
std::map<std::string, ClosingSchedule> DelayBy(const std::map<std::string, double>& delays);

/** Closing schedules with which the digits of a grasp touch an object in succession with given
lags. Let L_d be the required lag of digit d after the first, and t_d its first touch in a trial
without variation,

    delay_d <- delay_d + L_d - (t_d - min t),   then all minus the least

This is repeated until every lag is correct within a step, since a late digit may find the object
displaced. If the full correction increases the error, half of it is applied, then a quarter, and so
on, in at most 16 trials. Proposed by graspbench. */
struct LaggedClosing {
  std::map<std::string, ClosingSchedule> closing;  ///< without digits that need no schedule
  double largest_error = 0.0;  ///< largest error of a lag [s]; NaN: no such closing was found
  std::string untouching;      ///< then: a digit that did not touch; empty: the simulation failed
};

/** @param setup  of the undelayed trial; the closing schedule of its grasp is ignored.
@param lags  by digit of the grasp [s], the least 0. */
LaggedClosing FitContactLags(TrialRunner& runner, TrialSetup setup,
                             const std::map<std::string, double>& lags);

}  // namespace graspbench
