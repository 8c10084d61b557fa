#include "core/trial/grip/grip_statics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/** Velocity of a point for a unit rate of a joint. */
Vector3d CalcMotion(const HandDynamics& dynamics, int joint, const Vector3d& p) {
  const SpatialVector& S = dynamics.motion(joint);
  return S.tail<3>() + S.head<3>().cross(p);
}

/** A hand in the target posture of a grasp. */
class ClosedHand {
 public:
  ClosedHand(const Hand& hand, const Grasp& grasp)
      : hand_(hand), dynamics_(hand), way_(grasp.q_target - grasp.q_pre) {
    dynamics_.UpdatePositions(Pose::Identity(), grasp.q_target);
  }

  /** Force at the pad of one digit. */
  double CalcPadForce(const Digit& digit) const;
  /** Bound for one digit, anywhere on its surface. */
  double CalcDigitBound(const Digit& digit) const;

 private:
  /** Largest force of the drive behind a joint at points no nearer to it than `lever`. */
  double CalcForceAt(const HandJoint& joint, double lever) const {
    const HandJoint& driven =
        joint.coupled_to < 0 ? joint : hand_.joints[static_cast<size_t>(joint.coupled_to)];
    return driven.drive.torque_limit / (joint.is_prismatic ? 1.0 : lever);
  }
  /** The last closing joint of a digit before this link; -1: none. */
  int FindClosingJoint(int link) const {
    int closing = -1;
    for (const int joint : dynamics_.chain(link)) {
      const int coupled_to = hand_.joints[static_cast<size_t>(joint)].coupled_to;
      if (way_[joint] != 0.0 || (coupled_to >= 0 && way_[coupled_to] != 0.0)) closing = joint;
    }
    return closing;
  }

  const Hand& hand_;
  HandDynamics dynamics_;
  Eigen::VectorXd way_;
};

double ClosedHand::CalcPadForce(const Digit& digit) const {
  const Vector3d p_HPad = dynamics_.X_WL(digit.distal_link) * digit.p_LPad;
  const std::vector<int>& chain = dynamics_.chain(digit.distal_link);
  Vector3d moved = Vector3d::Zero();
  for (const int joint : chain) moved += way_[joint] * CalcMotion(dynamics_, joint, p_HPad);
  if (moved.norm() == 0.0) return kUnbounded;
  Eigen::VectorXd arms = Eigen::VectorXd::Zero(dynamics_.num_dofs());
  for (const int joint : chain) {
    dynamics_.ForEachSpeed(joint, [&](int dof, double rate) {
      if (dynamics_.is_deviation(dof)) return;
      arms[dof] += rate * moved.normalized().dot(CalcMotion(dynamics_, joint, p_HPad));
    });
  }
  double largest = kUnbounded;
  for (int dof = 0; dof < dynamics_.num_dofs(); ++dof) {
    const int joint = dynamics_.joint_of_dof(dof);
    if (arms[dof] == 0.0 || way_[joint] == 0.0) continue;
    const double limit = hand_.joints[static_cast<size_t>(joint)].drive.torque_limit;
    largest = std::min(largest, limit / std::abs(arms[dof]));
  }
  return largest;
}

double ClosedHand::CalcDigitBound(const Digit& digit) const {
  std::vector<double> levers(hand_.joints.size(), kUnbounded);
  for (const ContactSphere& ball : hand_.contact_spheres) {
    if (std::find(digit.links.begin(), digit.links.end(), ball.link) == digit.links.end()) continue;
    const int joint = FindClosingJoint(ball.link);
    if (joint < 0) continue;
    const Vector3d moved = CalcMotion(dynamics_, joint, dynamics_.X_WL(ball.link) * ball.p_LS);
    double& lever = levers[static_cast<size_t>(joint)];
    lever = std::min(lever, std::max(moved.norm(), ball.radius));
  }
  double sum = 0.0;
  for (size_t joint = 0; joint < levers.size(); ++joint) {
    if (!std::isinf(levers[joint])) sum += CalcForceAt(hand_.joints[joint], levers[joint]);
  }
  return sum > 0.0 ? sum : kUnbounded;
}

}  // namespace

std::vector<int> ListGraspingDigits(const Hand& hand, const Grasp& grasp) {
  std::vector<int> digits;
  for (const std::string& id : grasp.digits) {
    for (size_t d = 0; d < hand.digits.size(); ++d) {
      if (hand.digits[d].id == id) digits.push_back(static_cast<int>(d));
    }
  }
  return digits;
}

std::vector<int> MapLinksToParts(const Hand& hand, const std::vector<int>& digits) {
  std::vector<int> parts(hand.links.size(), static_cast<int>(digits.size()));
  for (size_t part = 0; part < digits.size(); ++part) {
    for (const int link : hand.digits[static_cast<size_t>(digits[part])].links) {
      parts[static_cast<size_t>(link)] = static_cast<int>(part);
    }
  }
  return parts;
}

std::vector<PartLoad> CalcPartLoads(const std::vector<HandContact>& contacts,
                                    const std::vector<int>& parts, int num_parts,
                                    const HandDynamics& dynamics, const Vector3d& gravity_W) {
  const Vector3d down_W = gravity_W.normalized();
  std::vector<PartLoad> loads(static_cast<size_t>(num_parts));
  for (PartLoad& load : loads) load.torque = Eigen::VectorXd::Zero(dynamics.num_dofs());
  for (const HandContact& contact : contacts) {
    PartLoad& load = loads[static_cast<size_t>(parts[static_cast<size_t>(contact.link)])];
    load.force += contact.normal_force;
    const Vector3d f_W = contact.normal_force * contact.nhat_W + contact.friction_W;
    load.push_W += f_W - f_W.dot(down_W) * down_W;
    for (const int joint : dynamics.chain(contact.link)) {
      const double way = contact.nhat_W.dot(CalcMotion(dynamics, joint, contact.p_WC));
      dynamics.ForEachSpeed(joint, [&](int dof, double rate) {
        load.torque[dof] += contact.normal_force * rate * way;
      });
    }
  }
  for (PartLoad& load : loads) {
    if (load.force <= 0.0) continue;
    load.push_W /= load.force;
    load.torque /= load.force;
  }
  return loads;
}

void BalanceForces(const std::vector<PartLoad>& loads, const std::vector<int>& free,
                   std::vector<double>& forces) {
  for (const int part : free) forces[static_cast<size_t>(part)] = 0.0;
  Vector3d rest_W = Vector3d::Zero();
  for (size_t i = 0; i < loads.size(); ++i) rest_W -= forces[i] * loads[i].push_W;
  const auto push = [&](int part) { return loads[static_cast<size_t>(part)].push_W; };
  if (free.size() == 2) {
    const Vector3d a = push(free[0]), b = push(free[1]);
    const double determinant = a.dot(a) * b.dot(b) - a.dot(b) * a.dot(b);
    if (determinant > 1e-6) {
      const double x = (b.dot(b) * a.dot(rest_W) - a.dot(b) * b.dot(rest_W)) / determinant;
      const double y = (a.dot(a) * b.dot(rest_W) - a.dot(b) * a.dot(rest_W)) / determinant;
      if (x >= 0.0 && y >= 0.0) {
        forces[static_cast<size_t>(free[0])] = x;
        forces[static_cast<size_t>(free[1])] = y;
        return;
      }
    }
  }
  // Only one of them: the one that leaves the smallest residual.
  int best = -1;
  double best_force = 0.0, least = rest_W.squaredNorm();
  for (const int part : free) {
    const Vector3d n = push(part);
    if (n.squaredNorm() == 0.0) continue;
    const double force = std::max(0.0, n.dot(rest_W) / n.squaredNorm());
    if (const double left = (rest_W - force * n).squaredNorm(); left < least) {
      best = part;
      best_force = force;
      least = left;
    }
  }
  if (best >= 0) forces[static_cast<size_t>(best)] = best_force;
}

double CalcClosingStiffness(const Hand& hand, const HandDynamics& dynamics, const PartLoad& load,
                            const Eigen::VectorXd& way) {
  double gain = 0.0, compliance = 0.0;
  for (int dof = 0; dof < dynamics.num_dofs(); ++dof) {
    const int joint = dynamics.joint_of_dof(dof);
    const double arm = load.torque[dof];
    if (dynamics.is_deviation(dof)) {
      compliance += arm * arm * hand.joints[static_cast<size_t>(joint)].coupling_compliance;
      continue;
    }
    gain += arm * way[joint];
    compliance += arm * arm / hand.joints[static_cast<size_t>(joint)].drive.stiffness;
  }
  if (!(compliance > 0.0)) return kLeastStiffness;
  return std::max(kLeastStiffness, gain / compliance);
}

double CalcPadGrip(const Hand& hand, const Grasp& grasp) {
  const ClosedHand closed(hand, grasp);
  const int opposing = FindOpposingDigit(hand, grasp);
  const std::vector<int> grasping = ListGraspingDigits(hand, grasp);
  double largest = kUnbounded;
  for (const int d : grasping) {
    const double force = closed.CalcPadForce(hand.digits[static_cast<size_t>(d)]);
    if (d != opposing) {
      largest = std::min(largest, force);
    } else if (!grasp.palm_may_touch && grasping.size() > 1) {
      largest = std::min(largest, force / static_cast<double>(grasping.size() - 1));
    }
  }
  return largest;
}

double CalcGripBound(const Hand& hand, const Grasp& grasp) {
  const ClosedHand closed(hand, grasp);
  const int opposing = FindOpposingDigit(hand, grasp);
  const std::vector<int> grasping = ListGraspingDigits(hand, grasp);
  const bool has_opposing = grasping.size() == 2 && !grasp.palm_may_touch;
  double bound = kUnbounded;
  for (const int d : grasping) {
    if (d == opposing && !has_opposing) continue;
    bound = std::min(bound, closed.CalcDigitBound(hand.digits[static_cast<size_t>(d)]));
  }
  return bound;
}

}  // namespace graspbench
