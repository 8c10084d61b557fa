#include "core/trial/stability.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/quality/epsilon_fast.h"

namespace graspbench {
namespace {

constexpr double kMostLoads = 10.0;  ///< Q F / (m g) counts up to here
constexpr double kSlipSpeed = 0.01;  ///< [m/s]

double CalcQuality(const LoadedGrasp& grasp) {
  if (grasp.contacts.size() < 2) return 0.0;
  WrenchSpace space;
  space.torque_scale = grasp.radius;
  return CalcEpsilonBounds(CalcConeWrenches(grasp.contacts, space).wrenches).lower;
}

double CalcWeakestHoldingForce(const GraspInstant& instant) {
  std::vector<Eigen::Vector3d> directions;
  for (int axis = 0; axis < 3; ++axis) {
    directions.push_back(instant.R_OPalm.col(axis));
    directions.push_back(-instant.R_OPalm.col(axis));
  }
  const std::vector<double> forces = CalcHoldingForces(instant.grasp, directions);
  return *std::min_element(forces.begin(), forces.end());
}

Json ToJson(const StabilityPart& part) {
  return Json{{"sigma_n", JsonNumber(part.sigma)},
              {"sigma_proposed", JsonNumber(part.sigma_proposed)},
              {"quality", JsonNumber(part.quality)},
              {"normal_force_n", JsonNumber(part.normal_force)},
              {"slip_speed_m_per_s", JsonNumber(part.slip_speed)},
              {"opposition", JsonNumber(part.opposition)},
              {"num_samples", part.num_samples}};
}

StabilityPart StabilityPartFromJson(const Json& json) {
  StabilityPart part;
  part.sigma = NumberFrom(json.at("sigma_n"));
  part.sigma_proposed = NumberFrom(json.at("sigma_proposed"));
  part.quality = NumberFrom(json.at("quality"));
  part.normal_force = NumberFrom(json.at("normal_force_n"));
  part.slip_speed = NumberFrom(json.at("slip_speed_m_per_s"));
  part.opposition = NumberFrom(json.at("opposition"));
  part.num_samples = IntFrom(json.at("num_samples"));
  return part;
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
    const double quality = CalcQuality(grasp);
    const double normal_force =
        std::accumulate(grasp.normal_forces.begin(), grasp.normal_forces.end(), 0.0);
    const double loads = std::min(kMostLoads, quality * normal_force / grasp.weight.norm());
    const double opposition = instant.is_opposed ? 1.0 : 0.0;
    part.sigma += share * CalcWeakestHoldingForce(instant);
    part.sigma_proposed += share * loads * std::exp(-instant.slip_speed / kSlipSpeed) * opposition;
    part.quality += share * quality;
    part.normal_force += share * normal_force;
    part.slip_speed += share * instant.slip_speed;
    part.opposition += share * opposition;
  }
  return part;
}

Json ToJson(const Stability& stability) {
  return Json{{"sigma_n", JsonNumber(stability.sigma)},
              {"sigma_proposed", JsonNumber(stability.sigma_proposed)},
              {"stabilisation", ToJson(stability.stabilisation)},
              {"lift", ToJson(stability.lift)},
              {"hold", ToJson(stability.hold)}};
}

Stability StabilityFromJson(const Json& json) {
  Stability stability;
  stability.sigma = NumberFrom(json.at("sigma_n"));
  stability.sigma_proposed = NumberFrom(json.at("sigma_proposed"));
  stability.stabilisation = StabilityPartFromJson(json.at("stabilisation"));
  stability.lift = StabilityPartFromJson(json.at("lift"));
  stability.hold = StabilityPartFromJson(json.at("hold"));
  return stability;
}

}  // namespace graspbench
