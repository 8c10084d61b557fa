#include "core/hand/closing.h"

#include <algorithm>
#include <cmath>

#include "core/hand/hand.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kDecided = 0.2;          // share of the range
constexpr double kLeastApproach = 0.005;  // of a tip [m]

Vector3d CalcTip(const Hand& hand, const Digit& digit, const Eigen::VectorXd& q) {
  return CalcLinkPose(hand, q, digit.distal_link) * digit.p_LTip;
}

/** Mean distance between the tips. */
double CalcTipSpread(const Hand& hand, const Eigen::VectorXd& q) {
  double sum = 0.0;
  int num_pairs = 0;
  for (size_t a = 0; a < hand.digits.size(); ++a) {
    for (size_t b = 0; b < a; ++b, ++num_pairs) {
      sum += (CalcTip(hand, hand.digits[a], q) - CalcTip(hand, hand.digits[b], q)).norm();
    }
  }
  return num_pairs > 0 ? sum / num_pairs : 0.0;
}

int FindClosingOfSlide(const Hand& hand, int joint) {
  const HandJoint& slide = hand.joints[joint];
  const auto calc_spread = [&](double position) {
    Eigen::VectorXd q = CalcClosedPosture(hand, {}, 0.0);
    q[joint] = position;
    ApplyCoupling(hand, q);
    return CalcTipSpread(hand, q);
  };
  const double change = calc_spread(slide.upper) - calc_spread(slide.lower);
  if (std::abs(change) < 0.05 * (slide.upper - slide.lower)) return 0;
  return change < 0.0 ? 1 : -1;
}

/** Whether the axis is roughly parallel to that of the digit's outermost revolute joint. */
bool Bends(const Hand& hand, int joint, const std::vector<Pose>& X_HL) {
  constexpr double kAlong = 0.7;
  const auto calc_axis = [&](int link) -> Vector3d {
    return X_HL[link].linear() * hand.links[link].axis;
  };
  const Digit& digit = hand.digits[hand.FindDigitOfLink(hand.joints[joint].link)];
  for (size_t k = digit.links.size(); k-- > 0;) {
    const int outer = hand.links[digit.links[k]].joint;
    if (outer < 0 || hand.joints[outer].is_prismatic) continue;
    return std::abs(calc_axis(hand.joints[joint].link).dot(calc_axis(digit.links[k]))) > kAlong;
  }
  return false;
}

double CalcPosition(const HandJoint& joint, int direction, double share) {
  const double open = direction > 0 ? joint.lower : joint.upper;
  const double closed = direction > 0 ? joint.upper : joint.lower;
  return open + share * (closed - open);
}

/** If the limits of the hand determine no direction, with zero in the middle of each range: closes
the joints that bend a digit so that its tip approaches the mean of the others. */
void CloseUndecided(const Hand& hand, const std::vector<Pose>& X_HL, std::vector<int>& closing) {
  if (hand.digits.size() < 2 ||
      std::any_of(closing.begin(), closing.end(), [](int direction) { return direction != 0; })) {
    return;
  }
  const Eigen::VectorXd open = CalcClosedPosture(hand, closing, 0.0);
  for (const Digit& digit : hand.digits) {
    std::vector<int> joints;
    for (const int link : digit.links) {
      const int j = hand.links[link].joint;
      if (j < 0 || hand.joints[j].is_prismatic || hand.joints[j].coupled_to >= 0) continue;
      if (Bends(hand, j, X_HL)) joints.push_back(j);
    }
    Vector3d middle = Vector3d::Zero();
    for (const Digit& other : hand.digits) {
      if (&other == &digit) continue;
      middle += CalcTip(hand, other, open) / (static_cast<double>(hand.digits.size()) - 1.0);
    }
    const auto calc_distance = [&](double share) {
      Eigen::VectorXd q = open;
      for (const int j : joints) q[j] = CalcPosition(hand.joints[j], 1, share);
      ApplyCoupling(hand, q);
      return (CalcTip(hand, digit, q) - middle).norm();
    };
    const double change = calc_distance(1.0) - calc_distance(0.0);
    if (std::abs(change) < kLeastApproach) continue;
    for (const int j : joints) closing[j] = change < 0.0 ? 1 : -1;
  }
}

}  // namespace

std::vector<int> FindClosing(const Hand& hand) {
  std::vector<int> closing(hand.joints.size(), 0);
  bool has_slide = false;
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, CalcClosedPosture(hand, {}, 0.0));
  for (int j = 0; j < hand.num_joints(); ++j) {
    const HandJoint& joint = hand.joints[j];
    if (joint.coupled_to >= 0 || hand.FindDigitOfLink(joint.link) < 0) continue;
    const double range = joint.upper - joint.lower;
    if (joint.is_prismatic) {
      closing[j] = FindClosingOfSlide(hand, j);
      has_slide = true;
    } else if (std::abs(joint.upper + joint.lower) > kDecided * range && Bends(hand, j, X_HL)) {
      closing[j] = joint.upper + joint.lower > 0.0 ? 1 : -1;
    }
  }
  CloseUndecided(hand, X_HL, closing);
  // Fingers that close completely pass each other, so any approach during closing counts.
  const auto calc_spread = [&](double share) {
    return CalcTipSpread(hand, CalcClosedPosture(hand, closing, share));
  };
  if (hand.digits.size() == 2 && !has_slide &&
      std::min({calc_spread(0.25), calc_spread(0.5), calc_spread(0.75), calc_spread(1.0)}) >
          calc_spread(0.0)) {
    for (int& direction : closing) direction = -direction;
  }
  return closing;
}

Eigen::VectorXd CalcClosedPosture(const Hand& hand, const std::vector<int>& closing, double share) {
  Eigen::VectorXd q(hand.num_joints());
  for (int j = 0; j < hand.num_joints(); ++j) {
    const HandJoint& joint = hand.joints[j];
    q[j] = std::clamp(0.0, joint.lower, joint.upper);
    if (!closing.empty() && closing[j] != 0) q[j] = CalcPosition(joint, closing[j], share);
  }
  ApplyCoupling(hand, q);
  return q;
}

bool MovesDigit(const Hand& hand, int joint, const Digit& digit) {
  return std::any_of(digit.links.begin(), digit.links.end(), [&](int link) {
    const int own = hand.links[link].joint;
    return own == joint || (own >= 0 && hand.joints[own].coupled_to == joint);
  });
}

void CloseDigit(const Hand& hand, const std::vector<int>& closing, const Digit& digit, double share,
                Eigen::VectorXd& q) {
  for (int j = 0; j < hand.num_joints(); ++j) {
    if (closing[j] == 0 || !MovesDigit(hand, j, digit)) continue;
    q[j] = CalcPosition(hand.joints[j], closing[j], share);
  }
}

}  // namespace graspbench
