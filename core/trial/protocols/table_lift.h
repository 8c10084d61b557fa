#pragma once
/** @file
The five-phase trial on a table: the strategy commands the hand, the world moves, the course takes
notes; its outcomes are in table_lift_outcome.h.

    TableLift course(world, setup);
    course.Begin();
    while (course.Advance()) {}      // one step of the physics each
    TrialResult result = course.End();

An instant between two steps can be saved and restored, in this course or in another of an equal
setup: from there the trial goes on to the very same bytes wherever the world's clone does
(ImplicitWorld), as often as wanted. Cost of Save and Restore: some 0.1 ms and 0.1 to 0.2 MB each,
see tests/bench/sim_bench.cc. */

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/grasp/placement.h"
#include "core/grasp/strategy.h"
#include "core/physics/world.h"
#include "core/trial/grip/grip_regulator.h"
#include "core/trial/judge/judge.h"
#include "core/trial/measures/contact_events.h"
#include "core/trial/measures/load_recorder.h"
#include "core/trial/measures/object_in_hand.h"
#include "core/trial/measures/stability.h"
#include "core/trial/protocols/palm_approach.h"
#include "core/trial/protocols/protocol.h"
#include "core/trial/protocols/table_lift_outcome.h"
#include "core/trial/trial_result.h"
#include "core/trial/trial_setup.h"
#include "core/vision/locate_object.h"

namespace graspbench {

/** What a course knows besides the world; a value. */
struct TrialNotes {
  GraspStrategy strategy;
  StabilityMeter stability;
  ContactEventRecorder events;
  LoadRecorder loads;
  GripRegulator grip;
  PalmApproach palm;
  TrialResult result = {};  ///< as far as known; times since the start

  bool is_over = false;
  Phase phase = Phase::kPlacing;
  WorldCommand command = {};                 ///< the last one
  StepReport report = {};                    ///< of the last step
  std::optional<TouchSensors> sensors = {};  ///< of a trial that goes by them
  std::string policy_fault = {};             ///< what a controller answered wrongly
  ArmFault arm_fault = ArmFault::kNone;      ///< why the arm cannot carry the hand there
  std::string arm_reason = {};               ///< the same in words
  Eigen::VectorXd q_reached = {};            ///< of the arm at the end of its gross motion [rad]
  double clear_time = 0.0;    ///< of placing, in which the arm's hand meets nothing [s]
  std::string not_seen = {};  ///< why the camera did not find the object
  double time = 0.0;          ///< since the start [s]
  double closure_start = kUnset;
  double last_touch = 0.0;
  double unconverged_time = 0.0;
  double start_gap = 0.0;                                   ///< of hand and object at the start [m]
  double rest_height = 0.0;                                 ///< of the object's O [m]
  double rest_extent = 0.0;                                 ///< height of the object [m]
  Eigen::Vector3d rest_position = Eigen::Vector3d::Zero();  ///< p_WOcm [m]
  SeatMeter seat = {};
  SteadyContacts steady = {};
  std::optional<Eigen::Vector3d> held_at = {};  ///< p_HOcm at the start of the hold
  std::optional<Pose> settled_at = {};          ///< X_PalmOcm when creep starts to count
};

/** A saved instant of a trial. Copies share the world, which nobody changes. */
struct TrialInstant {
  std::shared_ptr<const World> world;
  TrialNotes notes;
};

class TableLift : public TrialCourse {
 public:
  /** @param world   of the setup's hand, object and physics.   @param setup  outlives the course.
  @param camera  for positioning by camera; null: one is made, which takes some 0.1 s.
  @throws Error(kUnsupported) for positioning by camera of a hand that has none, and for sensed touch
  of one that feels nothing. */
  TableLift(std::unique_ptr<World> world, const TrialSetup& setup, WristCamera* camera = nullptr);

  /** What the hand's camera sees before the hand comes. @param camera  as of the constructor. */
  Sighting Look(WristCamera* camera) const;

  void Begin() override;
  bool Advance() override;
  /** What the strategy would ask for in the next step if nothing touched, without physics: the rest
  of the course of a trial that is over early. Unset: its last phase has ended. */
  std::optional<WorldCommand> ComputeOpenLoopCommand();
  /** @pre ComputeOpenLoopCommand was not called, too. */
  TrialResult End() override;

  /** @pre Begin was called. */
  TrialInstant Save() const;
  /** @pre saved by a course of the same hand, object, grasp, settings and draw. */
  void Restore(const TrialInstant& instant);

  double time() const override { return notes_.time; }
  Phase phase() const override { return notes_.phase; }
  double closure_start() const override { return notes_.closure_start; }
  const StepReport& report() const override { return notes_.report; }
  /** What it knows so far. */
  const TrialNotes& notes() const { return notes_; }
  bool is_held() const override;
  Judgement Judge() const override;
  double FindStrength() const override;
  const WorldCommand& last_command() const override { return notes_.command; }

 protected:
  virtual StrategyObservation FindObservation();
  virtual WorldCommand MakeCommand(const StrategyCommand& command) const;
  /** s of the closing law of a grasping digit, by its place in `digits_`. */
  virtual double FindClosing(size_t digit) const { return notes_.grip.closing(digit); }
  /** X_WO at rest. */
  Pose CalcRestPose(double x, double y, double yaw) const;
  /** X_WO at rest, where the hand takes the object to be. */
  Pose CalcBelievedPose() const;

  const TrialSetup& setup_;
  Placement placement_;                     // where the hand believes it
  std::vector<int> digits_;                 // grasping digits, indices into hand_.digits
  std::vector<HandContact> hand_contacts_;  // of the last step; kept for its memory
  TrialNotes notes_;

 private:
  /** Names the noise of camera and sensors. */
  std::string FormatDraw() const;
  Pose CalcStartPose() const;
  /** The posture with the draw's joint error, within the limits. */
  Eigen::VectorXd ApplyError(const Eigen::VectorXd& q) const;
  /** Moves the placement to where the hand believes the object. */
  void Position(WristCamera* camera);
  /** Plans the course of the setup's arm and puts it into its ready posture. False: it has none. */
  bool StartReach();
  /** Makes the command one of the gross motion, in which the hand takes its pre-grasp posture. */
  void Reach(WorldCommand& command) const;
  /** What the arm's joints do in a step. */
  void ObserveArm();
  double CalcArmStiffness(const Eigen::Vector3d& direction_W) const;
  double FindPlacingStart(const Pose& X_WO, const Eigen::VectorXd& q);
  /** X_WH so long before the hand arrives. */
  Pose CalcPlacingPose(double before_arrival) const;
  /** How many steps of the settings' length the next one is. */
  int ChooseNumSteps() const;
  /** Of the strategy, and the digits' closing with it. */
  StrategyCommand NextCommand(const StrategyObservation& observation, int num_steps);
  void Observe(const StepReport& report);
  void ObserveTouches();
  void EnterPhase(Phase phase);
  SceneSnapshot TakeSnapshot(Moment moment) const;
  TrialFacts MakeFacts() const;
  HeldObject Hold() const;
  double CalcExtent() const;
  std::optional<Opposition> FindHeldOpposition() const;
  double CalcRise() const {
    return world_->CalcObjectPose().translation().z() - notes_.rest_height;
  }
  double CalcCreep() const;
  /** Between the object and the spheres of some links, of all where `links` is null [m]. */
  double CalcGap(const std::vector<int>* links) const;
  SeatMeter::Place FindPlace() const;  ///< of the object in the palm's frame
  bool IsTouching(int digit) const;
  double CalcTouchTime(int digit) const;

  const Hand& hand_;
  double object_radius_;  // about its centre of mass [m]
};

}  // namespace graspbench
