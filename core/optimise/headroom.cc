#include "core/optimise/headroom.h"

#include <algorithm>

#include "core/statistics/summary.h"

namespace graspbench {

double CalcFrictionBound(double normal_force, double friction, double weight) {
  return std::max(0.0, friction * normal_force - weight);
}

double CalcMostGain(double share) { return std::max(1.0, 1.0 / share); }

Headroom CalcHeadroom(const std::vector<LearningTrial>& trials, const GraspObject& object,
                      double gravity) {
  const double weight = object.mass_properties.mass * gravity;
  std::vector<double> bounds, loads;
  for (const LearningTrial& trial : trials) {
    const double load = trial.strength.value_or(trial.sigma);
    if (!(load > 0.0)) continue;
    bounds.push_back(
        CalcFrictionBound(trial.stability.normal_force, object.surface.friction_static, weight));
    loads.push_back(load);
  }
  const double bound = CalcMean(bounds);
  return {bound, CalcMean(loads) / bound};
}

}  // namespace graspbench
