#pragma once
/** @file
The surface of a compressible object, which gives way to the balls of a hand.

The body stays rigid in the large. Its surface is a bed of independent springs (Winkler 1867;
Johnson 1985, "Contact Mechanics", 4.3): the pressure grows with the depth to which the hand's
surface lies below that at rest, so a force is a stiffness per volume times the displaced volume,

    p = K(n) y        F = K(n) V

    K(n)     = force / V1(R1, d(n))           n  the surface's normal, in O
    d(n)     = n^T yield n                    half of what the size loses along each axis
    V1(R, y) = pi y^2 (R - y / 3)             one ball, y <= R; from there on + pi R^2 per depth

K is that of one known grip: a fingertip that presses with `force` goes down by d(n). The reference
fingertip is one ball of radius R1 = 7 mm, that of the TUM Hand, which held the compressible objects
of the thesis. R1, the bed and its linear law are proposed.

Balls that press side by side share the bed: each displaces what lies where it is the deepest, up to
where their spheres meet. So the force depends on the shape that the balls cover, not on their
number. It is the slope of one energy, K / 2 times the depth squared over the surface.

Within a step F = c y^2 with c = K V / y^2 of its start. From kMostYield d(n) on the surface yields
no more: it is as stiff as a rigid one. d(n) below kLeastYield counts as rigid.

Loading and unloading follow one curve: no dent stays. What is lost is the contact's relaxation
(contact.h). A cycle of several balls returns what it took within 0.05 %, the error of the sum over
directions; the relaxation takes more in any cycle that is shorter than a minute.

Limits: balls are pressed into something flat within their patch; along the surface nothing gives
way (a skin of paper or foil); the table meets a rigid body of its size at rest; mass and inertia
stay those at rest; a body that is pressed on one side does not swell on another. K follows n: a
contact that rolls to a stiffer place gains up to 2/3 F times the change of d(n) without work; one
that slides there loses more by friction, where mu times the path is longer than that. The distance
field's gradient turns at the middle of a body. kLeastSizeOfGrasp keeps the deepest point of a hand
at two fifths of a side at most, before that middle. */

#include <Eigen/Core>
#include <vector>

#include "core/shape/grasp_object.h"

namespace graspbench {

inline constexpr double kReferenceRadius = 0.007;  ///< R1 [m]
inline constexpr double kMostYield = 2.0;          ///< of d(n)
inline constexpr double kLeastYield = 1e-5;        ///< [m]

/** How a surface gives way to one contact point within a step: F = factor y^2 up to `depth`. */
struct SurfaceYield {
  double factor = 0.0;  ///< c [N/m^2]; 0: the surface is rigid
  double depth = 0.0;   ///< [m]
};

/** A ball of a hand on the surface. */
struct PressingBall {
  Eigen::Vector3d p_OCentre = Eigen::Vector3d::Zero();
  Eigen::Vector3d nhat_O = Eigen::Vector3d::UnitZ();  ///< of the surface, outwards
  double radius = 0.0;                                ///< [m]
  double depth = 0.0;                                 ///< negative: a gap [m]
};

/** V1 [m^3]. @pre 0 <= depth. */
double CalcDisplacedVolume(double radius, double depth);

/** K(n) [N/m^3]; infinite where the surface is rigid. */
double CalcStiffnessPerVolume(const Compressibility& object, const Eigen::Vector3d& nhat_O);

/** Of each of the balls, which all press on one object. */
void CalcSurfaceYields(const Compressibility& object, const std::vector<PressingBall>& balls,
                       std::vector<SurfaceYield>& yields);

}  // namespace graspbench
