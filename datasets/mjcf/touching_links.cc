#include "datasets/mjcf/touching_links.h"

#include <algorithm>

namespace graspbench {

std::set<std::pair<int, int>> FindLinksTouchingAtRest(const Hand& hand) {
  constexpr int kBalls = 64;
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()));
  const auto touch = [&](const LinkCapsule& a, const LinkCapsule& b) {
    const Eigen::Vector3d a0 = X_HL[a.link] * a.p_LA, a1 = X_HL[a.link] * a.p_LB;
    const Eigen::Vector3d b0 = X_HL[b.link] * b.p_LA, axis = X_HL[b.link] * b.p_LB - b0;
    const double length2 = axis.squaredNorm();
    for (int k = 0; k <= kBalls; ++k) {
      const Eigen::Vector3d p = a0 + (a1 - a0) * k / kBalls - b0;
      const double share = length2 > 0.0 ? std::clamp(p.dot(axis) / length2, 0.0, 1.0) : 0.0;
      if ((p - share * axis).norm() <= a.radius + b.radius) return true;
    }
    return false;
  };
  std::set<std::pair<int, int>> touching;
  for (const LinkCapsule& a : hand.capsules) {
    for (const LinkCapsule& b : hand.capsules) {
      if (a.link >= b.link || hand.FindDigitOfLink(a.link) == hand.FindDigitOfLink(b.link))
        continue;
      if (touch(a, b)) touching.insert({a.link, b.link});
    }
  }
  return touching;
}

}  // namespace graspbench
