#pragma once
/** @file
A trial in the second world (core/physics/simbody/compliant_world.h): there to be compared with. */

#include "core/trial/trial_result.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

/** The whole course of a trial, judged by the same rules. Never throws for what happens inside a
trial. @pre CanMoveCompliantly(*setup.object). */
TrialResult RunCompliantTrial(const TrialSetup& setup);

}  // namespace graspbench
