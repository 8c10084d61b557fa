#pragma once
/** @file
The largest pull that the measured contacts of a grasp can resist:

    maximise s   so that contact forces exist with

        sum_i f_i + weight + s d = 0      forces balance
        |sum_i p_i x f_i| <= tolerance    moments about the centre of mass balance, too
        f_i in its cone                   friction of its state, soft pads
        sum of a digit's normal forces    at most the measured sum: a digit presses no harder, but
                                          may redistribute its force among its contacts

The cone of a contact with the normal force N is that of the physics (core/physics/contact.h),

    |f_t|^2 / mu^2 + M_n^2 / torsion^2 <= N^2

with the friction f_t and the moment M_n about the normal; it is the friction ellipsoid of Howe and
Cutkosky 1996. The result is 0 if the contacts cannot carry the weight.

The tolerance is 3 % of the total normal force times the object's radius, in any direction. Contacts
are patches and move along as the object turns slightly. Without the tolerance, pinches of two
points would have a result of 0 because of moments that a real finger resists immediately.

Method: a linear program over generators of the cones (linear_program.h) with column generation. The
dual prices of its optimum identify, for each cone, the generator with the largest gain. Generators
are added until none gains more than a share of the result: 3e-4 here and 1e-5 for the smallest
grip. So pulls are at most that much too low and grips too high, and neither depends on the frame.
With five contacts, a direction takes some 20 us and a smallest grip 50 us.

Source: Haschke, Steil, Steuwer, Ritter, CIRA 2005 (task forces), here with the forces that fingers
exert instead of a unit effort, and with the weight; column generation: Dantzig and Wolfe,
Operations Research 8, 1960. Not considered: drives that yield before contacts slip, and fingers
that press harder when the object is pushed into them. */

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/quality/wrench_space.h"

namespace graspbench {

/** Contacts of a grasp with their forces. Positions are relative to the centre of mass; all vectors
are in one frame fixed to the object. */
struct LoadedGrasp {
  std::vector<GraspContact> contacts;
  std::vector<double> normal_forces;  ///< per contact [N]
  std::vector<int> digits;            ///< per contact; equal numbers share their normal force
  Eigen::Vector3d weight = Eigen::Vector3d::Zero();  ///< m g as a force [N]
  double radius = 0.0;  ///< largest distance of the object's surface from its centre of mass [m]
};

/** Returns s for each direction of the pull (unit vectors) [N].
@throws Error(kRange) if rounding hides the optimum (linear_program.h). */
std::vector<double> CalcHoldingForces(const LoadedGrasp& grasp,
                                      const std::vector<Eigen::Vector3d>& directions);
/** Returns the smallest of them. Only directions that may be the weakest are solved to the end. */
double CalcWeakestHoldingForce(const LoadedGrasp& grasp,
                               const std::vector<Eigen::Vector3d>& directions);

/** Computes the smallest force with which the digits of a grasp bear the object's weight:

    minimise F + 20 |M| / radius   so that contact forces exist with

        sum_i f_i + weight = 0            forces balance
        sum_i p_i x f_i = M,              moments about the centre of mass balance, except for what
        |M| <= tolerance                  the contacts' patches resist
        f_i in its cone                   as above
        sum of a digit's normal forces    at most F; unlimited for free ones (the digit that opposes
                                          the others, the palm)

For two opposed digits on a horizontal line, F = weight / (2 mu). The tolerance is 3 % of the total
normal force times the object's radius, as above, but at a price. A moment is left to the patches
only if balancing it would raise F by more than 20 |M| / radius. The moment about the line between
two hard contacts cannot be balanced otherwise. Without the price, pinches with a safety factor of 1
turn and slip.

F is the force of the digit that presses most. The sum with equal shares of F can exceed the sum
with uneven ones. The Shadow Hand, for example, holds a can with 0.74 to 0.84 of the sum of equal
shares, while its index finger presses with 1.4 to 1.6 F.

Source: Cloutier and Yang, J. Mechanisms Robotics 10:011004, 2018 (smallest sufficient contact
forces by linear and cone programs). Not considered: deviations from the balance due to stiff
fingers, accelerations, drives.

@returns F [N]; nullopt if no forces of these contacts bear the weight. `grasp.normal_forces` are
ignored.
@param is_free  per contact: the force of its digit is unlimited.
@throws Error(kRange) if rounding hides the optimum (linear_program.h). */
std::optional<double> CalcSmallestGrip(const LoadedGrasp& grasp, const std::vector<bool>& is_free);

}  // namespace graspbench
