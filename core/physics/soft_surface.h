#pragma once
/** @file
The surface of a compressible object, which yields to the balls of a hand.

The body as a whole stays rigid. Its surface is a bed of independent springs (Winkler 1867; Johnson
1985, "Contact Mechanics", 4.3). The pressure is proportional to the depth of the hand's surface
below the surface at rest, so a force is a stiffness per volume times the displaced volume,

    p = K(n) y        F = K(n) V

    K(n)     = force / V1(R1, d(n))           n  the surface's normal, in O
    d(n)     = n^T yield n                    half of the loss of size along each axis
    V1(R, y) = pi y^2 (R - y / 3)             one ball, y <= R; from there on + pi R^2 per depth

K is calibrated by one known grip: a fingertip that presses with `force` sinks in by d(n). The
reference fingertip is one ball of radius R1 = 7 mm, that of the TUM Hand, which held the
compressible objects of the thesis. R1, the bed and its linear law are proposed.

Balls that press side by side share the bed: each displaces the region in which it is deepest, up to
where their spheres intersect. So the force depends on the shape that the balls cover, not on their
number. It is the derivative of one energy, K / 2 times the depth squared over the surface.

Within a step F = c y^2, with c = K V / y^2 at its start. Beyond kMostYield d(n) the surface yields
no further and is as stiff as a rigid one. d(n) below kLeastYield counts as rigid.

Loading and unloading follow the same curve: there is no permanent dent. Losses come from the
contact's relaxation (contact.h). A cycle of several balls conserves energy within 0.05 %, the error
of the sum over directions; in any cycle shorter than a minute the relaxation dissipates more.

Limits: The surface is assumed to be flat within a ball's patch and does not yield tangentially (a
skin of paper or foil). The table touches a rigid body of the size at rest. Mass and inertia stay
those at rest. A body that is pressed on one side does not bulge on another. K follows n: a contact
that rolls to a stiffer region gains up to 2/3 F times the change of d(n) without work. If it slides
there, it loses more by friction, provided that mu times the path is longer than that. The gradient
of the distance field reverses at the middle of a body. kLeastSizeOfGrasp keeps the deepest point of
a hand at two fifths of a side at most, before that middle. */

#include <Eigen/Core>
#include <vector>

#include "core/shape/grasp_object.h"

namespace graspbench {

inline constexpr double kReferenceRadius = 0.007;  ///< R1 [m]
inline constexpr double kMostYield = 2.0;          ///< as a multiple of d(n)
inline constexpr double kLeastYield = 1e-5;        ///< [m]

/** Yield of a surface to one contact point within a step: F = factor y^2 up to `depth`. */
struct SurfaceYield {
  double factor = 0.0;  ///< c [N/m^2]; 0: the surface is rigid
  double depth = 0.0;   ///< [m]
};

/** A ball of a hand on the surface. */
struct PressingBall {
  Eigen::Vector3d p_OCentre = Eigen::Vector3d::Zero();
  Eigen::Vector3d nhat_O = Eigen::Vector3d::UnitZ();  ///< outward normal of the surface
  double radius = 0.0;                                ///< [m]
  double depth = 0.0;                                 ///< negative: a gap [m]
};

/** Returns V1 [m^3]. @pre 0 <= depth. */
double CalcDisplacedVolume(double radius, double depth);

/** Returns K(n) [N/m^3]; infinite if the surface is rigid. */
double CalcStiffnessPerVolume(const Compressibility& object, const Eigen::Vector3d& nhat_O);

/** Computes the yield for each of the balls, which all press on one object. */
void CalcSurfaceYields(const Compressibility& object, const std::vector<PressingBall>& balls,
                       std::vector<SurfaceYield>& yields);

}  // namespace graspbench
