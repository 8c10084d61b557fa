#pragma once
/** @file
The largest force that the measured contacts of a grasp can hold against a pull:

    maximise s   so that contact forces exist with

        sum_i f_i + weight + s d = 0      forces balance
        |sum_i p_i x f_i| <= tolerance    moments about the centre of mass too
        f_i in its cone                   friction of its state, soft pads
        sum of a digit's normal forces    at most what was measured: it presses no harder, but
                                          may shift its force among its contacts

The cone of a contact with the normal force N is that of the physics (core/physics/contact.h),

    |f_t|^2 / mu^2 + M_n^2 / torsion^2 <= N^2

with the friction f_t and the moment M_n about the normal; the friction ellipsoid of Howe and
Cutkosky 1996. Where contacts cannot carry the weight, nothing is left to pull at: 0.

Tolerance = 3 % of all normal force times the object's radius, whatever the direction: contacts are
patches and move along as the object turns a little. Without it, pinches of two points fall to 0 for
moments that a real finger takes up at once.

Method: a linear program over generators of the cones (linear_program.h). The prices of its optimum
name for each cone the generator that gains most; those that gain join the program, until none gains
more than a share of the result, 3e-4 here and 1e-5 for the smallest grip. So pulls are that much
too low at most and grips too high, and neither depends on the frame. Cost with five contacts: some
20 us for a direction, 50 us for a smallest grip.

Source: Haschke, Steil, Steuwer, Ritter, CIRA 2005 (task forces), here with the forces that fingers
exert instead of a unit effort, and with the weight; column generation: Dantzig and Wolfe,
Operations Research 8, 1960. Blind to: drives that yield before contacts slip, fingers that press
harder when the object is pushed into them. */

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/quality/wrench_space.h"

namespace graspbench {

/** Contacts of a grasp with the forces they exert; positions from the centre of mass, all vectors
in one frame fixed to the object. */
struct LoadedGrasp {
  std::vector<GraspContact> contacts;
  std::vector<double> normal_forces;  ///< of the contacts [N]
  std::vector<int> digits;            ///< of the contacts: equal numbers share their normal force
  Eigen::Vector3d weight = Eigen::Vector3d::Zero();  ///< m g as a force [N]
  double radius = 0.0;  ///< largest distance of the object's surface from its centre of mass [m]
};

/** s for each direction of the pull (unit vectors) [N].
@throws Error(kRange) where rounding hides the optimum (linear_program.h). */
std::vector<double> CalcHoldingForces(const LoadedGrasp& grasp,
                                      const std::vector<Eigen::Vector3d>& directions);
/** The least of them; only the directions that may be the weakest are looked at to the end. */
double CalcWeakestHoldingForce(const LoadedGrasp& grasp,
                               const std::vector<Eigen::Vector3d>& directions);

/** The smallest force with which the digits of a grasp bear the object's weight:

    minimise F + 20 |M| / radius   so that contact forces exist with

        sum_i f_i + weight = 0            forces balance
        sum_i p_i x f_i = M,              moments about the centre of mass, but for what the
        |M| <= tolerance                  contacts' patches bear
        f_i in its cone                   as above
        sum of a digit's normal forces    at most F; of free ones (the digit that opposes the
                                          others, the palm) what balance asks

For two opposed digits on a horizontal line F = weight / (2 mu). Tolerance = 3 % of all normal force
times the object's radius, as above, but at a price: a moment stays with the patches only where its
balance would raise F by more than 20 |M| / radius. The moment about the line of two hard contacts
has no other balance. Without the price pinches at a margin of 1 turn and slip.

F is of the digit that presses most. Equal shares of F sum to more than uneven ones may need: of a
can that the Shadow Hand holds with 0.74 to 0.84 of the sum of such shares, the index presses with
1.4 to 1.6 F.

Source: Cloutier and Yang, J. Mechanisms Robotics 10:011004, 2018 (smallest sufficient contact
forces by linear and cone programs). Blind to: shares that stiff fingers take against the balance,
accelerations, drives.

@returns F [N]; none where no forces of these contacts bear the weight. `grasp.normal_forces` are not
looked at. @param is_free  of each contact: its digit's force counts for nothing.
@throws Error(kRange) where rounding hides the optimum (linear_program.h). */
std::optional<double> CalcSmallestGrip(const LoadedGrasp& grasp, const std::vector<bool>& is_free);

}  // namespace graspbench
