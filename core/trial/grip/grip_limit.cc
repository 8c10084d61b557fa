#include "core/trial/grip/grip_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/physics/hand_dynamics.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/** Indices into Hand::digits. */
std::vector<int> ListGrasping(const Hand& hand, const Grasp& grasp) {
  std::vector<int> grasping;
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    const auto& ids = grasp.digits;
    if (std::find(ids.begin(), ids.end(), hand.digits[d].id) != ids.end()) {
      grasping.push_back(static_cast<int>(d));
    }
  }
  return grasping;
}

/** At the pad of one digit. */
double CalcPadForce(const Hand& hand, const HandDynamics& dynamics, const Eigen::VectorXd& way,
                    const Digit& digit) {
  const Vector3d p_HPad = dynamics.X_WL(digit.distal_link) * digit.p_LPad;
  const auto calc_way = [&](int joint) -> Vector3d {
    const SpatialVector& S = dynamics.motion(joint);
    return S.tail<3>() + S.head<3>().cross(p_HPad);
  };
  Vector3d moved = Vector3d::Zero();
  for (const int joint : dynamics.chain(digit.distal_link)) moved += way[joint] * calc_way(joint);
  if (moved.norm() == 0.0) return kUnbounded;
  Eigen::VectorXd arms = Eigen::VectorXd::Zero(dynamics.num_dofs());
  for (const int joint : dynamics.chain(digit.distal_link)) {
    dynamics.ForEachSpeed(joint, [&](int dof, double rate) {
      if (!dynamics.is_deviation(dof)) arms[dof] += rate * moved.normalized().dot(calc_way(joint));
    });
  }
  double largest = kUnbounded;
  for (int dof = 0; dof < dynamics.num_dofs(); ++dof) {
    const HandJoint& joint = hand.joints[static_cast<size_t>(dynamics.joint_of_dof(dof))];
    if (arms[dof] == 0.0 || way[dynamics.joint_of_dof(dof)] == 0.0) continue;
    largest = std::min(largest, joint.drive.torque_limit / std::abs(arms[dof]));
  }
  return largest;
}

/** What the drive behind a joint can give at places no nearer to it than this. */
double CalcForceAt(const Hand& hand, const HandJoint& joint, double lever) {
  const HandJoint& driven =
      joint.coupled_to < 0 ? joint : hand.joints[static_cast<size_t>(joint.coupled_to)];
  return driven.drive.torque_limit / (joint.is_prismatic ? 1.0 : lever);
}

/** The joint of a digit that closes and is the last before this link; -1: none. */
int FindClosingJoint(const HandDynamics& dynamics, const Hand& hand, const Eigen::VectorXd& way,
                     int link) {
  int closing = -1;
  for (const int joint : dynamics.chain(link)) {
    const int coupled_to = hand.joints[static_cast<size_t>(joint)].coupled_to;
    if (way[joint] != 0.0 || (coupled_to >= 0 && way[coupled_to] != 0.0)) closing = joint;
  }
  return closing;
}

/** Of one digit, wherever on its surface. */
double CalcDigitBound(const Hand& hand, const HandDynamics& dynamics, const Eigen::VectorXd& way,
                      const Digit& digit) {
  std::vector<double> levers(hand.joints.size(), kUnbounded);
  for (const ContactSphere& ball : hand.contact_spheres) {
    if (std::find(digit.links.begin(), digit.links.end(), ball.link) == digit.links.end()) continue;
    const int joint = FindClosingJoint(dynamics, hand, way, ball.link);
    if (joint < 0) continue;
    const SpatialVector& S = dynamics.motion(joint);  // of a unit axis
    const Vector3d moved = S.tail<3>() + S.head<3>().cross(dynamics.X_WL(ball.link) * ball.p_LS);
    double& lever = levers[static_cast<size_t>(joint)];
    lever = std::min(lever, std::max(moved.norm(), ball.radius));
  }
  double sum = 0.0;
  for (size_t joint = 0; joint < levers.size(); ++joint) {
    if (std::isinf(levers[joint])) continue;
    sum += CalcForceAt(hand, hand.joints[joint], levers[joint]);
  }
  return sum > 0.0 ? sum : kUnbounded;
}

}  // namespace

double CalcPadGrip(const Hand& hand, const Grasp& grasp) {
  HandDynamics dynamics(hand);
  dynamics.UpdatePositions(Pose::Identity(), grasp.q_target);
  const Eigen::VectorXd way = grasp.q_target - grasp.q_pre;
  const int opposing = FindOpposingDigit(hand, grasp);
  const std::vector<int> grasping = ListGrasping(hand, grasp);
  double largest = kUnbounded;
  for (const int d : grasping) {
    const double force = CalcPadForce(hand, dynamics, way, hand.digits[static_cast<size_t>(d)]);
    if (d != opposing) {
      largest = std::min(largest, force);
    } else if (!grasp.palm_may_touch && grasping.size() > 1) {
      largest = std::min(largest, force / static_cast<double>(grasping.size() - 1));
    }
  }
  return largest;
}

double CalcGripBound(const Hand& hand, const Grasp& grasp) {
  HandDynamics dynamics(hand);
  dynamics.UpdatePositions(Pose::Identity(), grasp.q_target);
  const Eigen::VectorXd way = grasp.q_target - grasp.q_pre;
  const int opposing = FindOpposingDigit(hand, grasp);
  const std::vector<int> grasping = ListGrasping(hand, grasp);
  const bool has_opposing = grasping.size() == 2 && !grasp.palm_may_touch;
  double bound = kUnbounded;
  for (const int d : grasping) {
    if (d == opposing && !has_opposing) continue;
    bound =
        std::min(bound, CalcDigitBound(hand, dynamics, way, hand.digits[static_cast<size_t>(d)]));
  }
  return bound;
}

}  // namespace graspbench
