#include "core/trial/measures/stability_meter.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

constexpr double kStabilisationWindow = 0.5;  ///< the last part of the phase that counts [s]
constexpr double kStabilisationInterval = 0.025;
constexpr double kLiftInterval = 0.1;
constexpr double kHoldInterval = 0.2;

}  // namespace

double CalcObjectRadius(const GraspObject& object) {
  double radius = 0.0;
  for (const Eigen::Vector3d& p_OV : object.mesh.vertices) {
    radius = std::max(radius, (p_OV - object.mass_properties.p_OOcm).norm());
  }
  return radius;
}

double CalcSlipSpeed(const WorldState& state, double object_radius) {
  return (state.v_WOcm - state.v_WH).norm() + object_radius * state.w_WO.norm();
}

StabilityMeter::StabilityMeter(const TrialSetup& setup)
    : hand_(setup.hand.get()),
      opposing_digit_(FindOpposingDigit(*setup.hand, setup.grasp)),
      step_(setup.sim.step),
      object_radius_(CalcObjectRadius(*setup.object)) {}

void StabilityMeter::Observe(const World& world, Phase phase, double time_in_phase, int num_steps) {
  std::vector<GraspInstant>* samples = nullptr;
  double interval = 0.0;
  switch (phase) {
    case Phase::kStabilisation:
      samples = &stabilisation_;
      interval = kStabilisationInterval;
      break;
    case Phase::kLiftOff:
      samples = &lift_;
      interval = kLiftInterval;
      break;
    case Phase::kHold:
      samples = &hold_;
      interval = kHoldInterval;
      break;
    case Phase::kPreGrasp:
    case Phase::kPlacing:
    case Phase::kClosure:
    case Phase::kDone:
      return;
  }
  const long number = std::lround(time_in_phase / step_);
  const long every = std::max(1L, std::lround(interval / step_));
  if (number % every < num_steps) samples->push_back(MakeInstant(world));
}

GraspInstant StabilityMeter::MakeInstant(const World& world) const {
  const WorldState& state = world.state();
  const Eigen::Matrix3d R_OW = state.R_WO.transpose();
  GraspInstant instant;
  LoadedGrasp& grasp = instant.grasp;
  grasp.weight = world.mass_properties().mass * (R_OW * state.gravity_W);
  grasp.radius = object_radius_;
  instant.R_OPalm = R_OW * CalcPalmPose(*hand_, state).linear();
  instant.slip_speed = CalcSlipSpeed(state, object_radius_);
  bool opposing_touches = false, other_touches = false;
  std::vector<HandContact> contacts;
  world.FindHandContacts(contacts);
  for (const HandContact& contact : contacts) {
    const int digit = hand_->FindDigitOfLink(contact.link);
    (digit == opposing_digit_ ? opposing_touches : other_touches) = true;
    grasp.contacts.push_back({R_OW * (contact.p_WC - state.p_WOcm),
                              (R_OW * contact.nhat_W).normalized(), contact.mu,
                              contact.mu * contact.torsion_radius, std::nullopt});
    grasp.normal_forces.push_back(contact.normal_force);
    grasp.digits.push_back(digit);
  }
  instant.is_opposed = opposing_touches && other_touches;
  return instant;
}

Stability StabilityMeter::Calc() const {
  Stability stability;
  const auto num_last =
      std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(stabilisation_.size()),
                               std::lround(kStabilisationWindow / kStabilisationInterval));
  const std::vector<GraspInstant> last(stabilisation_.end() - num_last, stabilisation_.end());
  stability.stabilisation = CalcStabilityPart(last);
  stability.lift = CalcStabilityPart(lift_);
  stability.hold = CalcStabilityPart(hold_);
  return stability;
}

}  // namespace graspbench
