#include "core/physics/contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace graspbench {
namespace {

/** A contact that is about to touch has the patch of this compression [m]. */
constexpr double kLeastCompression = 1e-6;

/** Sets the tangential stiffness and the torsion radius of a contact with a pad. */
void ApplyPatch(ContactPoint& contact) {
  ContactMaterial& material = contact.material;
  const PadCompression state = CalcCompression(contact, contact.depth);
  // hertz / (4/3 E*) is the root of R.
  const double patch = contact.hertz / (4.0 / 3.0 * material.pad.modulus) *
                       std::sqrt(std::max(state.compression, kLeastCompression));
  const double along = 4.0 / 3.0 * material.pad.modulus * patch;
  material.tangential_stiffness = 1.0 / (1.0 / along + 1.0 / material.tangential_stiffness);
  material.torsion_radius =
      std::min(material.torsion_radius, material.pad.torsion_scale * kHertzTorsionShare * patch);
}

/** Damping of the bristles over their stiffness. A pad loses as much tangentially as normally [s].
*/
double CalcDampingTime(const ContactPoint& contact) {
  return contact.hertz > 0.0 ? contact.material.relaxation_time : 1e-3;
}
/** Static friction recovers after this time without sliding [s]. */
constexpr double kRestTime = 0.02;

/** Friction before it is clipped: tangential components, and spin over the torsion radius [N]. */
using Bristle = std::array<double, 3>;

Bristle CalcBristle(const ContactPoint& contact, const ContactRates& rates, double h) {
  const double kt = contact.material.tangential_stiffness, r = contact.material.torsion_radius;
  const double gain = kt * (h + CalcDampingTime(contact));
  return {kt * contact.stretch[0] + gain * rates[kTangentRow1],
          kt * contact.stretch[1] + gain * rates[kTangentRow2],
          r > 0.0 ? r * (kt * contact.twist + gain * rates[kSpinRow]) : 0.0};
}

double CalcNorm(const Bristle& y) { return std::sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]); }

/** Returns the value that only one side defines, or `both` of the two; `neither` when none does. */
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

double CalcHertzFactor(double modulus, double radius) {
  return 4.0 / 3.0 * modulus * std::sqrt(radius);
}

double CalcPatchRadius(double modulus, double radius, double force) {
  return std::cbrt(0.75 * force * radius / modulus);
}

PadCompression CalcPadCompression(double hertz, double stiffness, double pad_depth, double x) {
  if (!(x > 0.0)) return {};
  const double full = hertz * pad_depth * std::sqrt(pad_depth);
  if (x >= pad_depth + full / stiffness) {
    return {pad_depth, stiffness * (x - pad_depth), stiffness};
  }
  // w^2 + (hertz / k) w^3 = x with w = sqrt(y). From above, Newton's iterates only decrease.
  const double ratio = hertz / stiffness;
  double w = std::sqrt(x);
  for (int i = 0; i < 50; ++i) {
    const double change = (w * w * (1.0 + ratio * w) - x) / (w * (2.0 + 3.0 * ratio * w));
    w -= change;
    if (change <= 1e-8 * w) break;  // the remaining error is its square
  }
  return {w * w, hertz * w * w * w, 1.0 / (1.0 / (1.5 * hertz * w) + 1.0 / stiffness)};
}

PadCompression CalcCompression(const ContactPoint& contact, double x) {
  if (!(x > 0.0)) return {};
  const double k = contact.material.stiffness, pad_depth = contact.material.pad.depth;
  const auto calc_rigid = [&](double depth) {
    return contact.hertz > 0.0 ? CalcPadCompression(contact.hertz, k, pad_depth, depth)
                               : PadCompression{0.0, k * depth, k};
  };
  const SurfaceYield& surface = contact.surface;
  if (surface.factor == 0.0) return calc_rigid(x);
  const double full = surface.factor * surface.depth * surface.depth;
  const double pad = contact.hertz > 0.0 ? std::pow(contact.hertz, -2.0 / 3.0) : 0.0;
  const auto calc_pad = [&](double root) { return pad * root * std::cbrt(root); };
  if (x >= surface.depth + std::min(calc_pad(std::sqrt(full)), pad_depth) + full / k) {
    PadCompression state = calc_rigid(x - surface.depth);
    state.surface = surface.depth;
    return state;
  }
  // With w the root of the force: w / sqrt(c) + pad w^(4/3) + w^2 / k = x.
  // The function is convex: from above, Newton's iterates only decrease.
  const double across = 1.0 / std::sqrt(surface.factor);
  const double at_pad_end = pad > 0.0 ? std::pow(pad_depth / pad, 0.75) : 0.0;
  const bool is_pad_full =
      pad > 0.0 && x >= at_pad_end * across + pad_depth + at_pad_end * at_pad_end / k;
  const double shared = is_pad_full ? x - pad_depth : x, elastic = is_pad_full ? 0.0 : pad;
  double w = std::min(shared / across, std::sqrt(k * shared)), slope = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double root = std::cbrt(w);
    slope = across + 4.0 / 3.0 * elastic * root + 2.0 * w / k;
    const double change = (across * w + elastic * w * root + w * w / k - shared) / slope;
    w -= change;
    if (change <= 1e-8 * w) break;
  }
  return {is_pad_full ? pad_depth : calc_pad(w), w * w, 2.0 * w / slope, across * w};
}

void SetRadius(double radius, ContactPoint& contact) {
  const PadMaterial& pad = contact.material.pad;
  if (pad.is_soft()) contact.hertz = CalcHertzFactor(pad.modulus, radius);
}

void PrepareContact(double h, int step_number, ContactPoint& contact) {
  const Eigen::Vector3d& n = contact.nhat_BA_W;
  // The axis least aligned with n gives a well-conditioned first tangent, the same every time.
  Eigen::Index least;
  n.cwiseAbs().minCoeff(&least);
  contact.tangent1_W = n.cross(Eigen::Vector3d::Unit(least)).normalized();
  contact.tangent2_W = n.cross(contact.tangent1_W);
  ContactMemory* memory = contact.memory;
  if (!memory) return;
  const ContactMaterial& material = contact.material;
  if (contact.hertz > 0.0 && material.tangential_stiffness > 0.0) ApplyPatch(contact);
  if (memory->last_step != step_number - 1) {
    const int last_slide = memory->last_slide;
    *memory = ContactMemory();
    memory->last_slide = last_slide;
  }

  // The bristle keeps its length when the tangent plane rotates.
  const Eigen::Vector3d in_plane = memory->stretch - n * n.dot(memory->stretch);
  const double length = memory->stretch.norm(), flat = in_plane.norm();
  const Eigen::Vector3d stretch =
      flat > 0.0 ? Eigen::Vector3d(in_plane * (length / flat)) : Eigen::Vector3d::Zero();
  contact.stretch = {contact.tangent1_W.dot(stretch), contact.tangent2_W.dot(stretch)};
  contact.twist = memory->twist;
  if (contact.hertz > 0.0 && memory->tangential_stiffness > 0.0) {
    const double scale = std::sqrt(memory->tangential_stiffness / material.tangential_stiffness);
    for (double& part : contact.stretch) part *= scale;
    const double r = material.torsion_radius;
    contact.twist = r > 0.0 ? contact.twist * scale * memory->torsion_radius / r : 0.0;
  }
  contact.is_dynamic = h * (step_number - memory->last_slide) < kRestTime;
  // Initial guess: the force changes as in the last step. The solver corrects it where it matters.
  double fn = memory->normal_force;
  if (!std::isnan(memory->normal_force_before)) {
    fn = std::clamp(2.0 * fn - memory->normal_force_before, 0.5 * fn, 2.0 * fn);
  }
  contact.friction_limit = contact.mu() * fn;
}

ContactForces CalcContactForces(const ContactPoint& contact, const ContactRates& rates, double h) {
  ContactForces result;
  const ContactMaterial& material = contact.material;
  const double vn = rates[kNormalRow];
  const double ahead = std::max(contact.depth, 0.0) -
                       (h + material.relaxation_time) * (vn - std::min(contact.depth, 0.0) / h);
  if (ahead > 0.0) {
    const PadCompression state = CalcCompression(contact, ahead);
    result.force[kNormalRow] = state.force;
    result.normal_slope = state.slope;
  }
  if (!contact.memory) return result;

  const double limit = contact.friction_limit;
  const Bristle y = CalcBristle(contact, rates, h);
  const double norm = CalcNorm(y);
  result.is_at_limit = norm > limit;
  const double share = result.is_at_limit ? limit / norm : 1.0;
  result.force[kTangentRow1] = -share * y[0];
  result.force[kTangentRow2] = -share * y[1];
  result.force[kSpinRow] = -share * y[2] * material.torsion_radius;
  return result;
}

ContactGains CalcContactGains(const ContactPoint& contact, const ContactRates& rates,
                              const ContactForces& forces, double h) {
  ContactGains result;
  const ContactMaterial& material = contact.material;
  result.normal = forces.normal_slope * (h + material.relaxation_time);
  if (!contact.memory) return result;

  const double r = material.torsion_radius;
  const double gain = material.tangential_stiffness * (h + CalcDampingTime(contact));
  if (!forces.is_at_limit) {
    result.friction = {gain, 0.0, gain, 0.0, 0.0, gain * r * r};
    return result;
  }
  if (contact.friction_limit == 0.0) return result;
  // Clipped friction keeps its direction c: only the part across c still grows with the rates.
  const Bristle y = CalcBristle(contact, rates, h);
  const double norm = CalcNorm(y), g = gain * (contact.friction_limit / norm);
  const Bristle c = {y[0] / norm, y[1] / norm, y[2] / norm};
  result.friction = {g * (1.0 - c[0] * c[0]), -g * c[0] * c[1],
                     g * (1.0 - c[1] * c[1]), -g * c[0] * c[2] * r,
                     -g * c[1] * c[2] * r,    g * (1.0 - c[2] * c[2]) * r * r};
  return result;
}

void FinishContact(const ContactPoint& contact, const ContactRates& mean_rates,
                   const ContactForces& forces, double h, int step_number) {
  ContactMemory* memory = contact.memory;
  const double fn = forces.force[kNormalRow];
  if (!memory || fn <= 0.0) return;  // a broken contact loses its memory
  const ContactMaterial& material = contact.material;
  const double kt = material.tangential_stiffness, r = material.torsion_radius;
  double s1 = contact.stretch[0] + h * mean_rates[kTangentRow1];
  double s2 = contact.stretch[1] + h * mean_rates[kTangentRow2];
  double twist = contact.twist + (r > 0.0 ? h * mean_rates[kSpinRow] : 0.0);
  if (forces.is_at_limit) {
    s1 = -forces.force[kTangentRow1] / kt;
    s2 = -forces.force[kTangentRow2] / kt;
    if (r > 0.0) twist = -forces.force[kSpinRow] / (kt * r * r);
  }
  memory->stretch = s1 * contact.tangent1_W + s2 * contact.tangent2_W;
  memory->twist = twist;
  memory->tangential_stiffness = kt;
  memory->torsion_radius = r;
  memory->normal_force_before =
      memory->last_step == step_number - 1 ? memory->normal_force : kUnset;
  memory->normal_force = fn;
  memory->last_step = step_number;
  if (forces.is_at_limit) memory->last_slide = step_number;
}

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
    // A pad's patch resists spin by its size, up to the limit of the other side.
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
