#pragma once
/** @file
A trial in which one digit closes later than the others, towards the same target: what a lack of
simultaneity does when nothing else differs. With t0 the start of closure and T the closure time,
the digit's joints are asked for

    q(t) = q_pre + s (q_target - q_pre),   s = clamp((t - t0 - delay) / T, 0, 1)

instead of the same without the delay (strategy.h). The phases go on as the strategy decides: a
digit that is late beyond the strategy's patience still closes during stabilisation. */

#include <string>

#include "core/trial/trial_result.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

/** The id of the digit that touched first or last in a trial without delay; empty where fewer than
two touched or closure did not begin: then there is nothing to delay.
@pre the result has its snapshots. */
std::string FindLateDigit(const TrialResult& undelayed, LateDigit which);

/** The setup with the lateness that `setup.late` and `setup.delay` ask for; without any where there
is nothing to delay. @param undelayed  the result of the same trial without delay. */
TrialSetup DelayLateDigit(TrialSetup setup, const TrialResult& undelayed);

/** @param digit  index into Hand::digits.
@param delay  >= 0 [s], rounded to whole steps. */
TrialSetup DelayDigit(TrialSetup setup, int digit, double delay);

}  // namespace graspbench
