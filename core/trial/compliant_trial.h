#pragma once
/** @file
A trial in the second world (core/physics/compliant_world.h): there to be compared with. */

#include "core/trial/trial_result.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

/** Whether the object is a ball; seams and dimples do not count. */
bool CanRunCompliant(const GraspObject& object);

/** The whole course of a trial, judged by the same rules. Never throws for what happens inside a
trial. @pre CanRunCompliant. */
TrialResult RunCompliantTrial(const TrialSetup& setup);

}  // namespace graspbench
