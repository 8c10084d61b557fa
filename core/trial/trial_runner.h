#pragma once
/** @file
One grasp trial by the setup's protocol (protocols/protocol.h), carried out by a hand on an object in
physics.

@code
#include "core/hand/load_hand.h"
std::shared_ptr<const GraspObject> object;  // from LoadObject("golf_ball"), objects/catalogue.h
const auto hand = std::make_shared<const Hand>(LoadHand("tum"));
TrialSetup setup;
setup.hand = hand;
setup.object = object;
setup.grasp = LoadStandardGrasps(*hand).front();
setup.draw.joint_error = Eigen::VectorXd::Zero(hand->num_joints());
const TrialResult result = TrialRunner(hand, object).Run(setup);
const bool is_held = IsSuccess(result.outcome);  // if not: result.reason
@endcode */

#include <functional>
#include <memory>
#include <optional>

#include "core/physics/world.h"
#include "core/trial/judge/judgement.h"
#include "core/trial/trial_result.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

struct JudgedTrial {
  TrialResult result;
  std::optional<Judgement> judgement;  ///< unset: nothing was in the hand at the end of the hold
};

class TrialCourse;
class WristCamera;

/** Runs trials of one hand and object; builds their world once, and each trial runs in a copy.
Not to be shared between threads. Never throws for what happens inside a trial. */
class TrialRunner {
 public:
  /** @throws Error(kUnsupported) for a hand with a longer chain of joints than the solver holds. */
  TrialRunner(std::shared_ptr<const Hand> hand, std::shared_ptr<const GraspObject> object);
  ~TrialRunner();
  /** What the first Run would do before its trial: points on the surfaces of a large object may take
  seconds. What cannot be made, Run says. */
  void Prepare(const SimConfig& sim);
  /** @pre setup.hand and setup.object are those of the constructor. */
  TrialResult Run(const TrialSetup& setup);
  /** The same, to the same bytes, watched: `observe` is called at the start and after every step. */
  TrialResult Run(const TrialSetup& setup, const std::function<void(TrialCourse&)>& observe);
  /** The same trial, and then the judge of what it holds (judge.h); some five times the cost. */
  JudgedTrial Judge(const TrialSetup& setup);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/** A trial whose grasp is chosen by what the hand's camera sees: the outline of the object suggests
a type (core/vision/locate_object.h), and the hand does its grasp of this type. The camera looks as
for positioning by camera, in the pre-grasp posture of TrialSetup::grasp. Where the hand goes is the
setup's positioning; a hand that is positioned by camera looks again in the pre-grasp of the chosen
grasp.

@returns the setup with the grasp that was chosen and none left to choose; `sight` says what was. A
setup that has none to choose stays as it is.
@pre there is one of each type that an outline suggests: power, two and all finger precision.
@param world   of the setup's hand, object and physics.   @param camera  of both; null: one is made.
@throws Error(kUnsupported) for a hand without a camera; Error(kEnvironment) where no picture can be
made. */
///@{
TrialSetup ChooseGraspBySight(TrialSetup setup, std::unique_ptr<World> world, WristCamera* camera);
TrialSetup ChooseGraspBySight(TrialSetup setup);
///@}

}  // namespace graspbench
