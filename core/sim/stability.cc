#include "core/sim/stability.h"

#include <algorithm>
#include <cmath>

#include "core/grasp/epsilon_fast.h"

namespace graspbench {
namespace {

constexpr double kMostLoads = 10.0;  ///< Q F / (m g) counts up to here
constexpr double kSlipSpeed = 0.01;  ///< [m/s]

double CalcQuality(const GraspInstant& instant, double object_radius) {
  if (instant.contacts.size() < 2) return 0.0;
  WrenchSpace space;
  space.torque_scale = object_radius;
  return CalcEpsilonBounds(CalcConeWrenches(instant.contacts, space).wrenches).lower;
}

Json ToJson(const StabilityPart& part) {
  return Json{{"sigma", JsonNumber(part.sigma)},
              {"quality", JsonNumber(part.quality)},
              {"normal_force_n", JsonNumber(part.normal_force)},
              {"slip_speed_m_per_s", JsonNumber(part.slip_speed)},
              {"opposition", JsonNumber(part.opposition)},
              {"num_samples", part.num_samples}};
}

StabilityPart StabilityPartFromJson(const Json& json) {
  StabilityPart part;
  part.sigma = NumberFrom(json.at("sigma"));
  part.quality = NumberFrom(json.at("quality"));
  part.normal_force = NumberFrom(json.at("normal_force_n"));
  part.slip_speed = NumberFrom(json.at("slip_speed_m_per_s"));
  part.opposition = NumberFrom(json.at("opposition"));
  part.num_samples = IntFrom(json.at("num_samples"));
  return part;
}

}  // namespace

StabilityPart CalcStabilityPart(const std::vector<GraspInstant>& samples, double weight,
                                double object_radius) {
  StabilityPart part;
  part.num_samples = static_cast<int>(samples.size());
  if (samples.empty()) return part;
  part.sigma = part.quality = part.normal_force = part.slip_speed = part.opposition = 0.0;
  for (const GraspInstant& instant : samples) {
    const double quality = CalcQuality(instant, object_radius);
    const double loads = std::min(kMostLoads, quality * instant.normal_force / weight);
    const double opposition = instant.is_opposed ? 1.0 : 0.0;
    const double share = 1.0 / part.num_samples;
    part.sigma += share * loads * std::exp(-instant.slip_speed / kSlipSpeed) * opposition;
    part.quality += share * quality;
    part.normal_force += share * instant.normal_force;
    part.slip_speed += share * instant.slip_speed;
    part.opposition += share * opposition;
  }
  return part;
}

Json ToJson(const Stability& stability) {
  return Json{{"sigma", JsonNumber(stability.sigma)},
              {"stabilisation", ToJson(stability.stabilisation)},
              {"lift", ToJson(stability.lift)},
              {"hold", ToJson(stability.hold)}};
}

Stability StabilityFromJson(const Json& json) {
  Stability stability;
  stability.sigma = NumberFrom(json.at("sigma"));
  stability.stabilisation = StabilityPartFromJson(json.at("stabilisation"));
  stability.lift = StabilityPartFromJson(json.at("lift"));
  stability.hold = StabilityPartFromJson(json.at("hold"));
  return stability;
}

}  // namespace graspbench
