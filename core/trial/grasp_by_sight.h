#pragma once
/** @file
A trial whose grasp is chosen by what the hand's camera sees: the outline of the object suggests a
type (core/vision/suggest_grasp.h), and the hand does its grasp of this type. The camera looks as
for positioning by camera, in the pre-grasp posture of TrialSetup::grasp. Where the hand goes is the
setup's positioning; a hand that is positioned by camera looks again in the pre-grasp of the chosen
grasp. */

#include <memory>

#include "core/physics/world.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

class WristCamera;

/** The setup with the grasp that was chosen and none left to choose; `sight` says what was. A setup
that has none to choose stays as it is.
@pre there is one of each type that an outline suggests: power, two and all finger precision.
@param world   of the setup's hand, object and physics.   @param camera  of both; null: one is made.
@throws Error(kUnsupported) for a hand without a camera; Error(kEnvironment) where no picture can be
made. */
///@{
TrialSetup ChooseGraspBySight(TrialSetup setup, std::unique_ptr<World> world, WristCamera* camera);
TrialSetup ChooseGraspBySight(TrialSetup setup);
///@}

}  // namespace graspbench
