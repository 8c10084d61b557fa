#include "core/trial/judge/held_object.h"

#include "core/trial/measures/stability_meter.h"

namespace graspbench {
namespace {

constexpr double kFreeTime = 0.05;   ///< [s]
constexpr double kRestSpeed = 1e-5;  ///< [m/s]

}  // namespace

HeldObject::HeldObject(const World& world, const WorldCommand& command, const TrialSetup& setup,
                       const GripRegulator& grip, const std::optional<TouchSensors>& sensors)
    : world_(world),
      command_(command),
      grip_(grip),
      sensors_(sensors),
      hand_(setup.hand.get()),
      object_(setup.object.get()),
      step_(setup.sim.step),
      mass_(setup.object->mass_properties.mass),
      radius_(CalcObjectRadius(*setup.object)),
      R_WPalm_(CalcPalmPose(*hand_, world.state()).linear()),
      X_PalmStart_(CalcObjectInPalm()) {
  command_.num_steps = 1;  // loads grow in every step
}

Pose HeldObject::CalcObjectInPalm() const {
  const WorldState& state = world_->state();
  return CalcPalmPose(*hand_, state).inverse() * MakePose(state.R_WO, state.p_WOcm);
}

void HeldObject::Regulate() {
  world_->FindHandContacts(contacts_);
  if (sensors_) sensors_->Observe(sensors_->time() + step_, contacts_, world_->dynamics());
  grip_.Observe(Phase::kHold, *world_, contacts_, sensors_ ? &*sensors_ : nullptr);
  grip_.Advance(Phase::kHold);
  grip_.Command(command_);
}

void HeldObject::Step() {
  const StepReport report = world_->Step(command_);
  time_ += step_;
  if (grip_.is_regulated()) Regulate();
  if (report.grip_force > 0.0) last_touch_ = time_;
  if (CalcSlipSpeed(world_->state(), radius_) > kRestSpeed) last_motion_ = time_;
  converged_ = converged_ && report.converged && report.is_finite;
}

double HeldObject::CalcMoved() const {
  return (CalcObjectInPalm().translation() - X_PalmStart_.translation()).norm();
}

double HeldObject::CalcSpeed() const {
  return (world_->state().v_WOcm - world_->state().v_WH).norm();
}

double HeldObject::CalcTurned() const {
  return Eigen::AngleAxisd(CalcObjectInPalm().linear() * X_PalmStart_.linear().transpose()).angle();
}

bool HeldObject::IsFree() const { return time_ - last_touch_ > kFreeTime; }

}  // namespace graspbench
