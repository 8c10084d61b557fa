#pragma once
/** @file
A held object after its trial: the hand goes on with its last command, or regulates its grip on,
while loads are put on the object or gravity is turned. Copies start from the same instant, so one
grasp stands many tests. */

#include "core/physics/world.h"
#include "core/trial/grip/grip_regulator.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

class HeldObject {
 public:
  /** @param world  at the end of the hold; cloned   @param command  the last one.
  @param sensors  of a hand that goes by them. */
  HeldObject(const World& world, const WorldCommand& command, const TrialSetup& setup,
             const GripRegulator& grip, const std::optional<TouchSensors>& sensors = {});

  /** Advances by one step of the physics. */
  void Step();

  World& world() { return *world_; }
  const World& world() const { return *world_; }
  const GraspObject& object() const { return *object_; }
  double step() const { return step_; }  ///< [s]
  double time() const { return time_; }  ///< since the start [s]
  double mass() const { return mass_; }
  double radius() const { return radius_; }  ///< largest distance of the surface from Ocm [m]
  /** Axes of the palm at the start, in W. */
  Eigen::Matrix3d R_WPalm() const { return R_WPalm_; }

  double CalcMoved() const;   ///< of the centre of mass in the palm's frame since the start [m]
  double CalcTurned() const;  ///< in the palm's frame since the start, 0..pi [rad]
  double CalcSpeed() const;   ///< of the centre of mass against the hand's root [m/s]
  /** Slower than 10 um/s for 0.1 s, turning included: it stays where it is. */
  bool IsAtRest() const { return time_ - last_motion_ > kRestTime; }
  /** The hand has not touched it for 50 ms. */
  bool IsFree() const;
  bool converged() const { return converged_; }  ///< all steps up to now

 private:
  static constexpr double kRestTime = 0.1;  // [s]

  Pose CalcObjectInPalm() const;
  void Regulate();

  WorldCopy world_;
  WorldCommand command_;
  GripRegulator grip_;
  std::optional<TouchSensors> sensors_;
  std::vector<HandContact> contacts_;
  const Hand* hand_;
  const GraspObject* object_;
  double step_, mass_, radius_;
  double time_ = 0.0, last_touch_ = 0.0, last_motion_ = 0.0;
  bool converged_ = true;
  Eigen::Matrix3d R_WPalm_;
  Pose X_PalmStart_;  // of Ocm
};

}  // namespace graspbench
