#pragma once
/** @file
Closed kinematic loops, which a tree of joints cannot represent. They are cut, and their passive
joints are coupled to the drive.

Over the drive's range, the passive joints q minimise the energy of their springs while the points
of each loop stay together and the joints within their limits,

    min sum k_i / 2 (q_i - rest_i)^2   with   p_A(q) = p_B(q),   lower_i <= q_i <= upper_i,

by Gauss-Newton steps with the closure as a stiff residual; joints at their limits are held (Nocedal
and Wright, Numerical Optimization, 2006, 16.7). Joints that move with the drive follow it along the
best-fitting line, whose error is reported; the others are fixed. An adaptive finger thus keeps the
shape that it has with nothing between its pads. */

#include <Eigen/Core>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {

/** Points of two links that coincide when all joints are at zero. */
struct LoopPoint {
  int line = 0;
  int link_A = -1, link_B = -1;
  Eigen::Vector3d p_AP = Eigen::Vector3d::Zero();  ///< in link A [m]
};

/** @param driven  joints with an actuator. Loops without one, or with several that do not follow
each other, are cut without a coupling and reported. */
void CloseLoops(const std::vector<LoopPoint>& points, const std::set<int>& driven,
                const std::string& file, Diagnostics& problems, ForeignHand& hand);

/** Couples a joint, and the joints that follow it, to another: q = offset + ratio q_leader. */
void FollowJoint(ForeignHand& hand, int joint, int leader, double ratio, double offset);

}  // namespace graspbench
