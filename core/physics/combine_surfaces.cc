#include "core/physics/combine_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graspbench {
namespace {

/** The value of the one side that gives it, or of `both`; `neither` when none does. */
template <class Both>
double Combine(double a, double b, double neither, Both&& both) {
  if (std::isnan(a)) return std::isnan(b) ? neither : b;
  return std::isnan(b) ? a : both(a, b);
}

double CombineFriction(double a, double b) {
  return Combine(a, b, 0.0, [](double mu_a, double mu_b) {
    return mu_a + mu_b > 0.0 ? 2.0 * mu_a * mu_b / (mu_a + mu_b) : 0.0;
  });
}

PadMaterial CombinePads(const SoftPad& a, const SoftPad& b) {
  constexpr double kPoisson = 0.5;
  double compliance = 0.0;  // 1 / E*
  for (const SoftPad* pad : {&a, &b}) {
    if (pad->youngs_modulus > 0.0) {
      compliance += (1.0 - kPoisson * kPoisson) / pad->youngs_modulus;
    }
  }
  return {1.0 / compliance, a.depth + b.depth, std::min(a.torsion_scale, b.torsion_scale)};
}

}  // namespace

ContactMaterial CombineSurfaces(const SurfaceMaterial& a, const SurfaceMaterial& b,
                                const SimConfig& config) {
  ContactMaterial pair;
  pair.stiffness = Combine(a.stiffness, b.stiffness, config.contact_stiffness,
                           [](double ka, double kb) { return ka * kb / (ka + kb); });
  pair.friction_static = CombineFriction(a.friction_static, b.friction_static);
  pair.friction_dynamic = CombineFriction(a.friction_dynamic, b.friction_dynamic);
  pair.torsion_radius = Combine(a.torsion_radius, b.torsion_radius, 0.0,
                                [](double r_a, double r_b) { return std::min(r_a, r_b); });
  pair.relaxation_time = Combine(a.relaxation_time, b.relaxation_time, kContactRelaxationTime,
                                 [](double t_a, double t_b) { return std::max(t_a, t_b); });
  if (a.pad.youngs_modulus > 0.0 || b.pad.youngs_modulus > 0.0) {
    pair.pad = CombinePads(a.pad, b.pad);
    // A pad's patch resists spin by its size, up to what the other side allows.
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (std::isnan(a.torsion_radius) && std::isnan(b.torsion_radius)) {
      pair.torsion_radius = kInfinity;
    }
  }
  pair.tangential_stiffness =
      config.tangential_stiffness * (pair.stiffness / config.contact_stiffness);
  return pair;
}

SurfaceMaterial MakeSelfSurface(const SurfaceMaterial& link, const SimConfig& config) {
  SurfaceMaterial surface = link;
  surface.torsion_radius = 0.0;
  if (std::isnan(link.friction_static)) {
    surface.friction_static = config.hand_friction_static;
    surface.friction_dynamic = config.hand_friction_dynamic;
  }
  return surface;
}

SurfaceMaterial MakeTableSurface(const SimConfig& config) {
  SurfaceMaterial table;
  table.friction_static = config.table_friction_static;
  table.friction_dynamic = config.table_friction_dynamic;
  table.torsion_radius = 0.0;
  return table;
}

}  // namespace graspbench
