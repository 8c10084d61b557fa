#pragma once
/** @file
How the pads of a hand lie to each other, and where its digits go. Of human grasping the literature
says that at the grip all pads lie in one plane (Iberall and MacKenzie 1990), and that closing
digits head for one point, where they would meet if no object were in their way (Cole and Abbs
1987). Each statement has a residual, which is 0 where it holds:

    plane    root mean square distance of the pads from the plane that is nearest to them:
             sqrt(l / n), with l the smallest eigenvalue of sum (p_i - c)(p_i - c)^T and c the mean
    meeting  root mean square distance of the lines p_i + s u_i from the point x that is nearest to
             all of them: sum (1 - u_i u_i^T)(x - p_i) = 0

Three pads always lie in a plane, so four are needed. Parallel lines have no single nearest point;
their residual is that of their spacing: five lines in a row, 20 mm apart, have 28.3 mm.

Both are lengths [m] in the unit of `pads`, and do not depend on the frame. */

#include <Eigen/Core>

namespace graspbench {

/** @param pads  a column a pad, in any frame. NaN with fewer than four. */
double CalcPlaneResidual(const Eigen::Matrix3Xd& pads);

/** @param directions  a column a pad: the way it goes, of any length above 0, in the same frame.
NaN with fewer than two pads, or where one does not move. */
double CalcMeetingResidual(const Eigen::Matrix3Xd& pads, const Eigen::Matrix3Xd& directions);

}  // namespace graspbench
