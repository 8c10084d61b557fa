#include "core/physics/pad_contact.h"

#include <algorithm>
#include <cmath>

#include "core/physics/contact.h"

namespace graspbench {
namespace {

/** The patch of a contact that is about to touch is that at this compression [m]. */
constexpr double kLeastCompression = 1e-6;

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
  // w^2 + (hertz / k) w^3 = x with w = sqrt(y). From above Newton only falls.
  const double ratio = hertz / stiffness;
  double w = std::sqrt(x);
  for (int i = 0; i < 50; ++i) {
    const double change = (w * w * (1.0 + ratio * w) - x) / (w * (2.0 + 3.0 * ratio * w));
    w -= change;
    if (change <= 1e-8 * w) break;  // what is left is its square
  }
  return {w * w, hertz * w * w * w, 1.0 / (1.0 / (1.5 * hertz * w) + 1.0 / stiffness)};
}

void ApplyPatch(ContactPoint& contact) {
  ContactMaterial& material = contact.material;
  const PadCompression state =
      CalcPadCompression(contact.hertz, material.stiffness, material.pad.depth, contact.depth);
  // hertz / (4/3 E*) is the root of R.
  const double patch = contact.hertz / (4.0 / 3.0 * material.pad.modulus) *
                       std::sqrt(std::max(state.compression, kLeastCompression));
  const double along = 4.0 / 3.0 * material.pad.modulus * patch;
  material.tangential_stiffness = 1.0 / (1.0 / along + 1.0 / material.tangential_stiffness);
  material.torsion_radius =
      std::min(material.torsion_radius, material.pad.torsion_scale * kHertzTorsionShare * patch);
}

}  // namespace graspbench
