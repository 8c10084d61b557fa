#include "core/trial/grip/grip_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/physics/hand_dynamics.h"

namespace graspbench {

using Eigen::Vector3d;

double CalcLargestGrip(const Hand& hand, const Grasp& grasp) {
  HandDynamics dynamics(hand);
  dynamics.UpdatePositions(Pose::Identity(), grasp.q_target);
  const Eigen::VectorXd way = grasp.q_target - grasp.q_pre;
  const int opposing = FindOpposingDigit(hand, grasp);
  double largest = std::numeric_limits<double>::infinity();
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    const Digit& digit = hand.digits[d];
    const bool grasps =
        std::find(grasp.digits.begin(), grasp.digits.end(), digit.id) != grasp.digits.end();
    if (!grasps || static_cast<int>(d) == opposing) continue;
    const Vector3d p_HPad = dynamics.X_WL(digit.distal_link) * digit.p_LPad;
    const auto calc_way = [&](int joint) -> Vector3d {
      const SpatialVector& S = dynamics.motion(joint);
      return S.tail<3>() + S.head<3>().cross(p_HPad);
    };
    Vector3d moved = Vector3d::Zero();
    for (const int joint : dynamics.chain(digit.distal_link)) moved += way[joint] * calc_way(joint);
    if (moved.norm() == 0.0) continue;
    Eigen::VectorXd arms = Eigen::VectorXd::Zero(dynamics.num_dofs());
    for (const int joint : dynamics.chain(digit.distal_link)) {
      dynamics.ForEachSpeed(joint, [&](int dof, double rate) {
        if (!dynamics.is_deviation(dof))
          arms[dof] += rate * moved.normalized().dot(calc_way(joint));
      });
    }
    for (int dof = 0; dof < dynamics.num_dofs(); ++dof) {
      const HandJoint& joint = hand.joints[static_cast<size_t>(dynamics.joint_of_dof(dof))];
      if (arms[dof] == 0.0 || way[dynamics.joint_of_dof(dof)] == 0.0) continue;
      largest = std::min(largest, joint.drive.torque_limit / std::abs(arms[dof]));
    }
  }
  return largest;
}

}  // namespace graspbench
