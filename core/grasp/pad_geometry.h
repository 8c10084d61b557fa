#pragma once
/** @file
Geometry of a hand's pads and of the directions in which its digits close. Two findings on human
grasping are tested. At the grip all pads lie in one plane (Iberall and MacKenzie 1990). Closing
digits head for one point, where they would meet without an object between them (Cole and Abbs
1987). Each statement has a residual, which is 0 where it holds:

    plane    root mean square distance of the pads from the plane nearest to them: sqrt(l / n),
             with l the smallest eigenvalue of sum (p_i - c)(p_i - c)^T and c the mean
    meeting  root mean square distance of the lines p_i + s u_i from the point x nearest to all of
             them: sum (1 - u_i u_i^T)(x - p_i) = 0

Three pads always lie in a plane, so four are needed. Parallel lines have no unique nearest point;
their residual follows from their spacing: five lines in a row, 20 mm apart, give 28.3 mm.

Both residuals have the unit of `pads` ([m]) and do not depend on the frame. */

#include <Eigen/Core>

namespace graspbench {

/** @param pads  one column per pad, in any frame. @returns NaN with fewer than four pads. */
double CalcPlaneResidual(const Eigen::Matrix3Xd& pads);

/** @param directions  one column per pad, in the same frame: its direction of motion, of any length
above 0. @returns NaN with fewer than two pads, or if a direction is zero. */
double CalcMeetingResidual(const Eigen::Matrix3Xd& pads, const Eigen::Matrix3Xd& directions);

}  // namespace graspbench
