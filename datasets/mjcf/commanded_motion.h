#pragma once
/** @file
What the hand is asked for in the course of a trial, step by step: what another engine needs to
carry out the same trial.

The strategy listens to the fingers (when all have touched, when the grip is steady), so the motion
is that of our own run. A trial that is over early here, because the object was lost, is commanded
to its end as if nothing touched: whether it is lost elsewhere too is for the other engine to
find. */

#include <string>
#include <vector>

#include "core/grasp/strategy.h"
#include "core/physics/world.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

struct MotionStep {
  Phase phase = Phase::kPlacing;
  WorldCommand command;  ///< for the step's end
};

struct CommandedMotion {
  WorldState start;
  double step = 0.0;              ///< [s]
  std::vector<MotionStep> steps;  ///< the first ends at `step`
};

/** Carries out the trial. @throws Error(kRange) when its start is not finite. */
CommandedMotion RecordMotion(const TrialSetup& setup);

/** One row a step, the start first: time_s, phase, arm_x_m .. arm_z_m and arm_x_m_per_s .. of the
root's displacement from the start along the world's axes, `<joint>_rad` of every drive. */
std::string FormatMotionCsv(const Hand& hand, const CommandedMotion& motion);

}  // namespace graspbench
