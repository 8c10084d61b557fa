#pragma once
/** @file
One trial in progress: the strategy commands the hand, the world moves, the course takes notes. */

#include <optional>
#include <vector>

#include "core/grasp/placement.h"
#include "core/grasp/strategy.h"
#include "core/physics/world.h"
#include "core/trial/judgement.h"
#include "core/trial/stability_meter.h"
#include "core/trial/trial_outcome.h"
#include "core/trial/trial_result.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

class TrialCourse {
 public:
  /** @param world  of the setup's hand, object and physics; left as the trial leaves it. */
  TrialCourse(World& world, const TrialSetup& setup);

  /** To be called once. @throws Error(kRange) when the start is not finite. */
  TrialResult Run();

  /** After Run: the object hangs in the hand, so that there is something to judge. */
  bool is_held() const { return is_held_; }
  /** @pre is_held() */
  Judgement Judge() const;
  /** What the hand was last asked for, to go on from there. */
  const WorldCommand& last_command() const { return command_; }

 private:
  void Start();
  WorldCommand MakeCommand(const StrategyCommand& command) const;
  void Observe(const StepReport& report, double closing);
  void ObserveTouches(double closing);
  void EnterPhase(Phase phase);
  void Finish();
  void TakeSnapshot(const char* name);
  TrialFacts MakeFacts() const;
  double CalcExtent() const;
  double CalcRise() const { return world_.CalcObjectPose().translation().z() - rest_height_; }
  double CalcGap(int digit) const;
  Pose CalcObjectInPalm() const;  ///< the frame Ocm in the palm's
  bool IsTouching(int digit) const;

  World& world_;
  const TrialSetup& setup_;
  const Hand& hand_;
  Placement placement_;
  GraspStrategy strategy_;
  StabilityMeter stability_;
  ContactEventRecorder events_;
  std::vector<HandContact> hand_contacts_;  // of the last step
  TrialResult result_;
  std::vector<int> digits_;  // grasping digits, indices into hand_.digits

  bool is_held_ = false;
  WorldCommand command_;
  StepReport report_;
  double time_ = 0.0;
  double closure_start_ = kUnset;
  double last_touch_ = 0.0;
  double unconverged_time_ = 0.0;
  double rest_height_ = 0.0;
  double rest_extent_ = 0.0;
  Eigen::Vector3d rest_position_ = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> held_at_;  // object in H at the start of the hold
  std::optional<Pose> settled_at_;          // object in the palm when creep starts to count
};

}  // namespace graspbench
