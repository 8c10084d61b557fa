#pragma once
/** @file
What a grasp can hold: everything (force closure), how evenly (smallest singular value), and how
much in one direction (task force). */

#include <Eigen/Core>

#include "core/quality/wrench_space.h"

namespace graspbench {

/** True if contact forces inside their cones can balance every wrench: the origin lies inside the
hull of the generators, which fill all dimensions. Without Qhull; the same margin as
CalcEpsilonBounds. */
bool IsForceClosure(const Eigen::MatrixXd& wrenches);

/** Smallest of the six singular values of the grasp matrix: how far the contacts are from a
configuration in which some wrench cannot be resisted at all, friction being unlimited. 0 if there
is such a wrench. Source: Li and Sastry, IEEE J. Robotics and Automation 4, 1988. */
double CalcMinSingularValue(const WrenchMatrix& grasp_matrix);

/** What the normal forces of the contacts may be. */
enum class ForceLimit {
  kSum,   ///< together at most 1 N: a fixed effort shared freely; consistent with epsilon
  kEach,  ///< at most 1 N at each contact: fingers of equal strength
};

/** The largest wrench s * direction the grasp can put on the object:

    maximise s   subject to   sum_j lambda_j w_j = s direction,  lambda >= 0,  ForceLimit

with the weights lambda_j in newtons of normal force (of total force where the generators have unit
total force). With kSum, the distance from the origin to the hull along the direction, thus never
below epsilon. 0 if the direction cannot be served at all; NaN should rounding defeat the program.

Source: Haschke, Steil, Steuwer, Ritter, "Task-oriented quality measures for dextrous grasping",
CIRA 2005, with its conic constraints replaced by the pyramids of wrench_space.h (a linear program).
@pre direction is a unit vector. */
double CalcTaskForce(const ConeWrenches& cones, const Eigen::Matrix<double, 6, 1>& direction,
                     ForceLimit limit);

}  // namespace graspbench
