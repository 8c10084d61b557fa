#pragma once
/** @file
Force over depth of a soft pad, and the patch of contact that results.

A ball of radius R with a pad of Young's modulus E and Poisson's ratio 1/2 pressed on something flat
and stiff (Hertz 1882; Johnson 1985, "Contact Mechanics", 4.2, 3.9 and 7.2):

    force over compression     F = 4/3 E* sqrt(R) y^1.5          E* = E / (1 - 1/4)
    radius of the patch        a = sqrt(R y)
    stiffness along it         kt = 4/3 E* a                     Mindlin 1949, nothing slips
    largest moment of twist    M = (3 pi / 16) mu F a            pressure of Hertz, all slips

The pad stands in series with the bare contact's spring: depth x = y + F / k, and a pad compressed
by all of its depth D yields no more: from there on F grows with k alone. Two pads on each other:
1/E* = 1/E1* + 1/E2*, 1/R = 1/R1 + 1/R2, D = D1 + D2.

Limits: small patches (a well below R and the pad's thickness; a thin layer on bone is stiffer), a
partner that is flat within the patch, no loss but that of every contact (contact.h), a coefficient
of friction that does not fall with pressure; the twist's stiffness kt r^2 is a third of the true
one. A link touches with several balls: a cylinder's flank of balls 0.8 R apart is within a fifth of
a line contact, (pi / 4) E* y per length (Popov 2010), at compressions around R / 15. */

#include "core/base/units.h"

namespace graspbench {

struct ContactPoint;

/** What both sides' pads come to. */
struct PadMaterial {
  double modulus = 0.0;  ///< E* [Pa]; 0: neither side has one
  double depth = 0.0;    ///< D [m]
  double torsion_scale = 1.0;

  bool is_soft() const { return modulus > 0.0; }
};

/** How a pad of force over compression F = hertz y^1.5 and a spring share a depth. */
struct PadCompression {
  double compression = 0.0;  ///< y [m]
  double force = 0.0;        ///< [N]
  double slope = 0.0;        ///< dF / dx [N/m]
};

/** @param hertz  4/3 E* sqrt(R) [N/m^1.5]   @param stiffness  k [N/m]
@param pad_depth  D [m]   @param x  depth [m]; no force at or below zero. */
PadCompression CalcPadCompression(double hertz, double stiffness, double pad_depth, double x);

/** Of the radius of Hertz's patch, all of which slips: M / (mu F a). */
inline constexpr double kHertzTorsionShare = 3.0 * kPi / 16.0;

/** a under a force, of Hertz's contact alone: (3 F R / (4 E*))^(1/3). */
double CalcPatchRadius(double modulus, double radius, double force);

/** 4/3 E* sqrt(R). */
double CalcHertzFactor(double modulus, double radius);

/** Sets the stiffness along the patch and the torsion radius of a contact with a pad. */
void ApplyPatch(ContactPoint& contact);

}  // namespace graspbench
