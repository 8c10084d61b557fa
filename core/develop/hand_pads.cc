#include "core/develop/hand_pads.h"

#include <algorithm>
#include <limits>

#include "core/hand/closing.h"
#include "core/hand/hand.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kThin = 1e-4;  // [m]

Vector3d FindNearestBall(const Hand& hand, const Digit& digit) {
  Vector3d p_LS = Vector3d::Zero();
  double nearest = std::numeric_limits<double>::infinity();
  for (const ContactSphere& ball : hand.contact_spheres) {
    if (ball.link != digit.distal_link) continue;
    const double distance = (ball.p_LS - digit.p_LPad).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    p_LS = ball.p_LS;
  }
  return p_LS;
}

}  // namespace

PadState CalcPadState(const Hand& hand, const Digit& digit, const std::vector<Pose>& X_HL) {
  const Pose& X_HF = X_HL[digit.distal_link];
  const Vector3d axis_L =
      digit.p_LTip.norm() > kThin ? digit.p_LTip.normalized() : Vector3d::UnitZ();
  Vector3d out_L = digit.p_LPad - digit.p_LPad.dot(axis_L) * axis_L;
  if (out_L.norm() < kThin) out_L = digit.p_LPad - FindNearestBall(hand, digit);
  if (out_L.norm() < kThin) out_L = axis_L.unitOrthogonal();
  return {X_HF * digit.p_LPad, X_HF.linear() * out_L.normalized(), X_HF.linear() * axis_L};
}

PadState CalcSideState(const Hand& hand, const Digit& digit, double side,
                       const std::vector<Pose>& X_HL) {
  PadState state = CalcPadState(hand, digit, X_HL);
  const Pose& X_HF = X_HL[digit.distal_link];
  for (size_t k = digit.links.size(); k-- > 0;) {
    const auto index = static_cast<size_t>(digit.links[k]);
    const HandLink& link = hand.links[index];
    if (link.joint < 0 || hand.joints[link.joint].is_prismatic) continue;
    state.nhat_H = side * (X_HL[index].linear() * link.axis);
    break;
  }
  // At the pad's position along the link, on its axis, then out to the outermost ball.
  const Vector3d p_HAxis =
      X_HF.translation() + (state.p_HPad - X_HF.translation()).dot(state.axis_H) * state.axis_H;
  double out = 0.0;
  for (const ContactSphere& ball : hand.contact_spheres) {
    if (ball.link != digit.distal_link) continue;
    out = std::max(out, (X_HF * ball.p_LS - p_HAxis).dot(state.nhat_H) + ball.radius);
  }
  state.p_HPad = p_HAxis + out * state.nhat_H;
  return state;
}

double CalcFingerLength(const Hand& hand) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, CalcClosedPosture(hand, {}, 0.0));
  double length = 0.0;
  for (const Digit& digit : hand.digits) {
    if (digit.is_thumb && hand.digits.size() > 1) continue;
    const Vector3d p_HBase = X_HL[digit.links.front()].translation();
    const Vector3d p_HTip = X_HL[digit.distal_link] * digit.p_LTip;
    length = std::max(length, (p_HTip - p_HBase).norm());
  }
  return length;
}

std::vector<int> FindGraspJoints(const Hand& hand, const std::vector<std::string>& digits) {
  std::vector<int> joints;
  for (const Digit& digit : hand.digits) {
    if (!std::count(digits.begin(), digits.end(), digit.id)) continue;
    for (const int joint : FindDrivenJoints(hand, digit)) joints.push_back(joint);
  }
  return joints;
}

Eigen::MatrixXd CalcPadJacobian(const Hand& hand, const Digit& digit, const Eigen::VectorXd& q,
                                const std::vector<int>& joints) {
  constexpr double kStep = 1e-6;
  const auto calc_pad = [&](const Eigen::VectorXd& posture) -> Vector3d {
    return CalcLinkPose(hand, posture, digit.distal_link) * digit.p_LPad;
  };
  Eigen::MatrixXd J(3, joints.size());
  for (size_t k = 0; k < joints.size(); ++k) {
    Eigen::VectorXd up = q, down = q;
    up[joints[k]] += kStep;
    down[joints[k]] -= kStep;
    ApplyCoupling(hand, up);
    ApplyCoupling(hand, down);
    J.col(static_cast<Eigen::Index>(k)) = (calc_pad(up) - calc_pad(down)) / (2.0 * kStep);
  }
  return J;
}

}  // namespace graspbench
