#pragma once
/** @file
Runs one grasp trial by the setup's protocol (protocols/protocol.h), with a hand and an object in
simulated physics.

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
  std::optional<Judgement> judgement;  ///< unset: nothing in the hand at the end of the hold
};

class TrialCourse;
class WristCamera;

/** Runs trials of one hand and object. Their world is built once, and each trial runs in a copy.
Not thread-safe. Never throws for events within a trial. */
class TrialRunner {
 public:
  /** @throws Error(kUnsupported) for a hand whose chain of joints is too long for the solver. */
  TrialRunner(std::shared_ptr<const Hand> hand, std::shared_ptr<const GraspObject> object);
  ~TrialRunner();
  /** Does what the first Run would do before its trial: sampling the surface of a large object may
  take seconds. Run reports failures. */
  void Prepare(const SimConfig& sim);
  /** @pre setup.hand and setup.object are those of the constructor. */
  TrialResult Run(const TrialSetup& setup);
  /** The same with byte-identical results; calls `observe` at the start and after every step. */
  TrialResult Run(const TrialSetup& setup, const std::function<void(TrialCourse&)>& observe);
  /** The same trial, followed by the judge of the held object (judge.h); about five times the
  cost. */
  JudgedTrial Judge(const TrialSetup& setup);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/** Chooses a trial's grasp from an image of the hand's camera. The outline of the object suggests a
grasp type (core/vision/locate_object.h), and the hand uses its grasp of this type. The image is
taken as for positioning by camera, in the pre-grasp posture of TrialSetup::grasp. The hand's
position follows from the setup's positioning; a hand that is positioned by camera takes another
image in the pre-grasp of the chosen grasp.

@returns the setup with the chosen grasp and no others to choose from; `sight` records the choice. A
setup without a choice is returned unchanged.
@pre there is one grasp of each type that an outline suggests: power, two and all finger precision.
@param world   with the setup's hand, object and physics.   @param camera  for both; null: created.
@throws Error(kUnsupported) for a hand without a camera; Error(kEnvironment) if no image can be
rendered. */
///@{
TrialSetup ChooseGraspBySight(TrialSetup setup, std::unique_ptr<World> world, WristCamera* camera);
TrialSetup ChooseGraspBySight(TrialSetup setup);
///@}

}  // namespace graspbench
