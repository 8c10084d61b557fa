#include "core/physics/contact.h"

#include <algorithm>
#include <cmath>

namespace graspbench {
namespace {

/** Damping of bristles as a time over their stiffness [s]. */
constexpr double kBristleDampingTime = 1e-3;
/** Static friction is back after this time without sliding [s]. */
constexpr double kRestTime = 0.02;

struct Bristle {
  double y1, y2, norm;
};

Bristle CalcBristle(const ContactPoint& contact, const ContactRates& rates, double h) {
  const double kt = contact.material.tangential_stiffness;
  const double gain = kt * (h + kBristleDampingTime);
  const double y1 = kt * contact.stretch[0] + gain * rates[kTangentRow1];
  const double y2 = kt * contact.stretch[1] + gain * rates[kTangentRow2];
  return {y1, y2, std::sqrt(y1 * y1 + y2 * y2)};
}

double CalcSpinStiffness(const ContactMaterial& material) {
  return material.tangential_stiffness * material.torsion_radius * material.torsion_radius;
}

}  // namespace

void PrepareContact(double h, int step_number, ContactPoint& contact) {
  const Eigen::Vector3d& n = contact.nhat_BA_W;
  // The axis least along n gives a well-conditioned first tangent, the same one every time.
  Eigen::Index least;
  n.cwiseAbs().minCoeff(&least);
  contact.tangent1_W = n.cross(Eigen::Vector3d::Unit(least)).normalized();
  contact.tangent2_W = n.cross(contact.tangent1_W);
  ContactMemory* memory = contact.memory;
  if (!memory) return;
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
  contact.is_dynamic = h * (step_number - memory->last_slide) < kRestTime;
  contact.friction_limit = contact.mu() * memory->normal_force;
}

ContactForces CalcContactForces(const ContactPoint& contact, const ContactRates& rates, double h) {
  ContactForces result;
  const ContactMaterial& material = contact.material;
  const double vn = rates[kNormalRow];
  const double depth = contact.depth - h * vn;
  const double damping = 1.0 - material.dissipation * vn;
  if (depth > 0.0 && damping > 0.0) {
    result.force[kNormalRow] = material.stiffness * depth * damping;
    result.normal_gain = material.stiffness * (h * damping + material.dissipation * depth);
  }
  if (!contact.memory) return result;

  const double limit = contact.friction_limit;
  const Bristle y = CalcBristle(contact, rates, h);
  const double gain = material.tangential_stiffness * (h + kBristleDampingTime);
  if (y.norm <= limit) {
    result.force[kTangentRow1] = -y.y1;
    result.force[kTangentRow2] = -y.y2;
    result.tangent_gain = {gain, 0.0, gain};
  } else {
    result.is_at_limit = true;
    const double c1 = y.y1 / y.norm, c2 = y.y2 / y.norm;
    result.force[kTangentRow1] = -limit * c1;
    result.force[kTangentRow2] = -limit * c2;
    const double across = gain * limit / y.norm;
    result.tangent_gain = {across * c2 * c2, -across * c1 * c2, across * c1 * c1};
  }
  if (material.torsion_radius > 0.0) {
    const double kr = CalcSpinStiffness(material);
    const double spin_gain = kr * (h + kBristleDampingTime);
    const double moment = kr * contact.twist + spin_gain * rates[kSpinRow];
    const double spin_limit = limit * material.torsion_radius;
    result.force[kSpinRow] = -std::clamp(moment, -spin_limit, spin_limit);
    result.spin_gain = std::abs(moment) <= spin_limit ? spin_gain : 0.0;
  }
  return result;
}

void FinishContact(const ContactPoint& contact, const ContactRates& rates,
                   const ContactForces& forces, double h, int step_number) {
  ContactMemory* memory = contact.memory;
  const double fn = forces.force[kNormalRow];
  if (!memory || fn <= 0.0) return;  // a broken contact forgets
  const ContactMaterial& material = contact.material;
  double s1 = contact.stretch[0] + h * rates[kTangentRow1];
  double s2 = contact.stretch[1] + h * rates[kTangentRow2];
  if (forces.is_at_limit) {
    s1 = -forces.force[kTangentRow1] / material.tangential_stiffness;
    s2 = -forces.force[kTangentRow2] / material.tangential_stiffness;
  }
  memory->stretch = s1 * contact.tangent1_W + s2 * contact.tangent2_W;
  if (material.torsion_radius > 0.0) {
    const double most =
        contact.friction_limit * material.torsion_radius / CalcSpinStiffness(material);
    memory->twist = std::clamp(contact.twist + h * rates[kSpinRow], -most, most);
  }
  memory->normal_force = fn;
  memory->last_step = step_number;
  if (forces.is_at_limit) memory->last_slide = step_number;
}

}  // namespace graspbench
