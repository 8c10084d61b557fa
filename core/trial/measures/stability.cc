#include "core/trial/measures/stability.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/units.h"
#include "core/quality/epsilon_fast.h"

namespace graspbench {
namespace {

constexpr double kStabilisationWindow = 0.5;  ///< last part of the phase that is used [s]
constexpr double kStabilisationInterval = 0.025;
constexpr double kLiftInterval = 0.1;
constexpr double kHoldInterval = 0.2;
constexpr double kMostLoads = 10.0;          ///< upper bound of Q F / (m g)
constexpr double kProposedSlipSpeed = 0.01;  ///< [m/s]

double CalcLeastPull(const GraspInstant& instant) {
  std::vector<Eigen::Vector3d> directions;
  for (int axis = 0; axis < 3; ++axis) {
    directions.push_back(instant.R_OPalm.col(axis));
    directions.push_back(-instant.R_OPalm.col(axis));
  }
  return CalcWeakestHoldingForce(instant.grasp, directions);
}

}  // namespace

StabilityPart CalcStabilityPart(const std::vector<GraspInstant>& samples) {
  StabilityPart part;
  part.num_samples = static_cast<int>(samples.size());
  if (samples.empty()) return part;
  part.sigma = part.sigma_proposed = part.quality = part.normal_force = part.slip_speed =
      part.opposition = 0.0;
  const double share = 1.0 / part.num_samples;
  for (const GraspInstant& instant : samples) {
    const LoadedGrasp& grasp = instant.grasp;
    const double quality = CalcContactQuality(grasp.contacts, grasp.radius);
    const double normal_force =
        std::accumulate(grasp.normal_forces.begin(), grasp.normal_forces.end(), 0.0);
    const double loads = std::min(kMostLoads, quality * normal_force / grasp.weight.norm());
    const double opposition = instant.is_opposed ? 1.0 : 0.0;
    part.sigma += share * CalcLeastPull(instant);
    part.sigma_proposed +=
        share * loads * std::exp(-instant.slip_speed / kProposedSlipSpeed) * opposition;
    part.quality += share * quality;
    part.normal_force += share * normal_force;
    part.slip_speed += share * instant.slip_speed;
    part.opposition += share * opposition;
  }
  return part;
}

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

GraspContact MakeGraspContact(const HandContact& contact, const WorldState& state, double mu) {
  const Eigen::Matrix3d R_OW = state.R_WO.transpose();
  return {R_OW * (contact.p_WC - state.p_WOcm), (R_OW * contact.nhat_W).normalized(), mu,
          mu * contact.torsion_radius, std::nullopt};
}

double CalcContactQuality(const std::vector<GraspContact>& contacts, double radius) {
  if (contacts.size() < 2) return 0.0;
  WrenchSpace space;
  space.torque_scale = radius;
  return CalcEpsilonBounds(CalcConeWrenches(contacts, space).wrenches).lower;
}

StabilityMeter::StabilityMeter(const TrialSetup& setup)
    : hand_(setup.hand.get()),
      opposing_digit_(FindOpposingDigit(*setup.hand, setup.grasp)),
      step_(setup.sim.step),
      object_radius_(CalcObjectRadius(*setup.object)) {}

void StabilityMeter::Observe(const World& world, Phase phase, double time_in_phase, int num_steps) {
  std::vector<GraspInstant>* samples = phase == Phase::kStabilisation ? &stabilisation_
                                       : phase == Phase::kLiftOff     ? &lift_
                                       : phase == Phase::kHold        ? &hold_
                                                                      : nullptr;
  if (!samples) return;
  const double interval = phase == Phase::kStabilisation ? kStabilisationInterval
                          : phase == Phase::kLiftOff     ? kLiftInterval
                                                         : kHoldInterval;
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
    grasp.contacts.push_back(MakeGraspContact(contact, state, contact.mu));
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
