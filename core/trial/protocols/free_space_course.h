#pragma once
/** @file
Hand and object in free space on their way through the stages of a grasp and what is done to the
object then. A copy goes on from the same instant, so that every push begins at it. */

#include <string>
#include <vector>

#include "core/physics/world.h"
#include "core/trial/protocols/profiled_scene.h"
#include "core/trial/trial_trace.h"

namespace graspbench {

/** From a pose of the object to another. */
struct ObjectMotion {
  double shift = 0.0;  ///< [m]
  double turn_deg = 0.0;
};

class FreeSpaceCourse {
 public:
  /** Both must outlive it. @param trace_interval  of the instants that are kept [s]; 0: none. */
  FreeSpaceCourse(const ProfiledScene& scene, const FreeSpaceProfile& profile,
                  double trace_interval = 0.0);

  /** Hand at the first stage, object at rest. Before all else. */
  void Begin();

  /** A force at the object's centre of mass, its mass times this, from now on [m/s^2]. */
  void Push(const Eigen::Vector3d& acceleration_W);

  /** From one pose and posture that are asked for to another, as the profile updates commands. */
  void Go(const Pose& X_WH0, const Eigen::VectorXd& q0, const Pose& X_WH1,
          const Eigen::VectorXd& q1, double duration);

  /** Closes with the object put back after each step until two of digits and palm touch it.
  @returns false: that never came, or the state is no longer finite. */
  bool CloseOnHeld(const Pose& X_WH, const Eigen::VectorXd& q, double duration);

  /** With the commands as they are. */
  void Wait(double duration);

  /** What the drives are asked for at a stage: under middle-first one drive bends both joints. */
  Eigen::VectorXd MakeCommand(const ScriptedStage& stage) const;

  /** From where it began, that raised by a height [m]. */
  ObjectMotion CalcMoved(double height = 0.0) const;

  /** Digits on the object after the last step, in the hand's order, then "palm". */
  std::vector<std::string> ListTouching() const;

  const World& world() const { return *world_; }
  const StepReport& report() const { return report_; }
  bool is_lift() const { return is_lift_; }
  bool is_finite() const { return report_.is_finite; }
  int num_steps() const { return num_steps_; }
  int num_unconverged() const { return num_unconverged_; }

  bool is_traced() const { return trace_interval_ > 0.0; }
  /** Of the instants from now on. */
  void SetPhase(Phase phase);
  /** All instants since Begin, the last among them; leaves none. */
  std::vector<TraceInstant> TakeTrace();

 private:
  WorldCopy MakeWorld() const;
  int CountSteps(double duration) const;
  /** At rest where it began. */
  void PutObject(WorldState& state) const;
  void Step();
  /** Keeps this instant, unless it is the last that was kept. */
  void Trace();

  const ProfiledScene& scene_;
  const FreeSpaceProfile& profile_;
  bool is_lift_;
  WorldCopy world_;
  WorldCommand command_;
  StepReport report_;
  int num_steps_ = 0, num_unconverged_ = 0;
  double trace_interval_;
  Phase phase_ = Phase::kPlacing;
  std::vector<TraceInstant> trace_;
};

}  // namespace graspbench
