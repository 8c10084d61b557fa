#include "core/trial/measures/stability.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/quality/epsilon_fast.h"

namespace graspbench {
namespace {

constexpr double kMostLoads = 10.0;          ///< Q F / (m g) counts up to here
constexpr double kProposedSlipSpeed = 0.01;  ///< [m/s]

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
    part.sigma_proposed +=
        share * loads * std::exp(-instant.slip_speed / kProposedSlipSpeed) * opposition;
    part.quality += share * quality;
    part.normal_force += share * normal_force;
    part.slip_speed += share * instant.slip_speed;
    part.opposition += share * opposition;
  }
  return part;
}

}  // namespace graspbench
