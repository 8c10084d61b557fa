#include "core/physics/contact.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace graspbench {
namespace {

/** Damping of bristles as a time over their stiffness; a pad loses along as it does across [s]. */
double CalcDampingTime(const ContactPoint& contact) {
  return contact.hertz > 0.0 ? contact.material.relaxation_time : 1e-3;
}
/** Static friction is back after this time without sliding [s]. */
constexpr double kRestTime = 0.02;

/** Friction before it is clipped: tangents, and spin over the torsion radius [N]. */
using Bristle = std::array<double, 3>;

Bristle CalcBristle(const ContactPoint& contact, const ContactRates& rates, double h) {
  const double kt = contact.material.tangential_stiffness, r = contact.material.torsion_radius;
  const double gain = kt * (h + CalcDampingTime(contact));
  return {kt * contact.stretch[0] + gain * rates[kTangentRow1],
          kt * contact.stretch[1] + gain * rates[kTangentRow2],
          r > 0.0 ? r * (kt * contact.twist + gain * rates[kSpinRow]) : 0.0};
}

double CalcNorm(const Bristle& y) { return std::sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]); }

}  // namespace

void SetRadius(double radius, ContactPoint& contact) {
  const PadMaterial& pad = contact.material.pad;
  if (pad.is_soft()) contact.hertz = CalcHertzFactor(pad.modulus, radius);
}

void PrepareContact(double h, int step_number, ContactPoint& contact) {
  const Eigen::Vector3d& n = contact.nhat_BA_W;
  // The axis least along n gives a well-conditioned first tangent, the same one every time.
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

  // The bristle keeps its length when the tangent plane turns.
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
  contact.friction_limit = contact.mu() * memory->normal_force;
}

ContactForces CalcContactForces(const ContactPoint& contact, const ContactRates& rates, double h) {
  ContactForces result;
  const ContactMaterial& material = contact.material;
  const double vn = rates[kNormalRow];
  const double ahead = std::max(contact.depth, 0.0) -
                       (h + material.relaxation_time) * (vn - std::min(contact.depth, 0.0) / h);
  if (ahead > 0.0) {
    if (contact.hertz > 0.0) {
      const PadCompression pad =
          CalcPadCompression(contact.hertz, material.stiffness, material.pad.depth, ahead);
      result.force[kNormalRow] = pad.force;
      result.normal_slope = pad.slope;
    } else {
      result.force[kNormalRow] = material.stiffness * ahead;
      result.normal_slope = material.stiffness;
    }
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
  // Clipped friction keeps its direction c: only what is across c still grows with the rates.
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
  if (!memory || fn <= 0.0) return;  // a broken contact forgets
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
  memory->normal_force = fn;
  memory->last_step = step_number;
  if (forces.is_at_limit) memory->last_slide = step_number;
}

}  // namespace graspbench
