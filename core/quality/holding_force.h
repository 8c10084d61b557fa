#pragma once
/** @file
The largest force that the measured contacts of a grasp can hold against a pull:

    maximise s   so that contact forces exist with

        sum_i f_i + weight + s d = 0      forces balance
        |sum_i p_i x f_i| <= tolerance    moments about the centre of mass too, axis by axis
        f_i in its cone                   friction of its state, soft pads (wrench_space.h)
        sum of a digit's normal forces    at most what was measured: it presses no harder, but
                                          may shift its force among its contacts

A linear program. Where contacts cannot carry the weight, nothing is left to pull at: 0.

Tolerance = 3 % of all normal force times the object's radius: contacts are patches and move along
as the object turns a little. Without it, pinches of two points fall to 0 for moments that a real
finger takes up at once.

Source: Haschke, Steil, Steuwer, Ritter, CIRA 2005 (task forces), here with the forces that fingers
exert instead of a unit effort, and with the weight. Blind to: drives that yield before contacts
slip, fingers that press harder when the object is pushed into them. */

#include <Eigen/Core>
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

}  // namespace graspbench
