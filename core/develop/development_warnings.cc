#include "core/develop/development_warnings.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/develop/hand_pads.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"

namespace graspbench {
namespace {

using Eigen::VectorXd;

constexpr double kNearestPads = 0.005, kFarthestPads = 0.09;  // distance of the pads [m]
constexpr int kNumDrawn = 3000, kNumRefined = 1500;           // number of postures
constexpr double kFirstChange = 0.3, kLastChange = 0.01;      // share of a joint's range

double CalcAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/** Half a turn for pads that are too near or too far. */
DigitOpposition CalcOpposition(const Hand& hand, const Digit& a, const Digit& b,
                               const VectorXd& q) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  const PadState pad_a = CalcPadState(hand, a, X_HL), pad_b = CalcPadState(hand, b, X_HL);
  const Eigen::Vector3d apart = pad_b.p_HPad - pad_a.p_HPad;
  const double distance = apart.norm();
  if (distance < kNearestPads || distance > kFarthestPads) return {kPi, distance};
  return {std::max(CalcAngle(pad_a.nhat_H, apart), CalcAngle(pad_b.nhat_H, -apart)), distance};
}

}  // namespace

DigitOpposition FindOpposition(const Hand& hand, size_t a, size_t b) {
  const std::vector<int> joints = FindGraspJoints(hand, {hand.digits[a].id, hand.digits[b].id});
  RandomStream stream(hand.digits[a].id + " " + hand.digits[b].id, "opposition of digits");
  VectorXd q_best = VectorXd::Zero(hand.num_joints());
  DigitOpposition best{kPi + 1.0, 0.0};
  for (int k = 0; k < kNumDrawn + kNumRefined; ++k) {
    const bool is_drawn = k < kNumDrawn;
    const double share = is_drawn ? 0.0 : static_cast<double>(k - kNumDrawn) / kNumRefined;
    const double step = kFirstChange * std::pow(kLastChange / kFirstChange, share);
    VectorXd q = q_best;
    for (const int j : joints) {
      const HandJoint& joint = hand.joints[j];
      const double range = joint.upper - joint.lower;
      q[j] = is_drawn ? joint.lower + range * stream.NextUnit()
                      : q[j] + step * range * stream.NextNormal();
      q[j] = std::clamp(q[j], joint.lower, joint.upper);
    }
    ApplyCoupling(hand, q);
    const DigitOpposition found = CalcOpposition(hand, hand.digits[a], hand.digits[b], q);
    if (found.angle >= best.angle) continue;
    best = found;
    q_best = q;
  }
  return best;
}

std::vector<std::string> ListPairsApart(const Hand& hand, const std::vector<std::string>& digits) {
  Grasp grasp;
  grasp.digits = digits;
  const auto opposing = static_cast<size_t>(FindOpposingDigit(hand, grasp));
  std::vector<std::string> sentences;
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    if (d == opposing || !std::count(digits.begin(), digits.end(), hand.digits[d].id)) continue;
    const DigitOpposition found = FindOpposition(hand, opposing, d);
    if (found.angle <= kLargestOppositionAngle) continue;
    sentences.push_back(fmt::format(
        "{} and {} cannot oppose: {}", hand.digits[opposing].id, hand.digits[d].id,
        found.angle >= kPi
            ? "their pads come no nearer than 90 mm"
            : fmt::format("their pads face each other within {:.0f} degrees at "
                          "best, {:.0f} would hold",
                          DegFromRad(found.angle), DegFromRad(kLargestOppositionAngle))));
  }
  return sentences;
}

namespace {

constexpr double kMostFailures = 0.01;  // share of numerical failures
constexpr double kLeastHeld = 0.1;      // share of the check's shapes
constexpr double kHalf = 0.5;           // share below which the opposition of two digits is checked

}  // namespace

std::vector<std::string> ListDevelopmentWarnings(const Hand& hand,
                                                 const DevelopedGrasp& developed) {
  std::vector<std::string> warnings;
  const int num_held = CountSuccesses(developed.check);
  const auto num_shapes = static_cast<double>(developed.check.size());
  if (num_held < kLeastHeld * num_shapes) {
    warnings.push_back(fmt::format(
        "it held {} of {} shapes not met before; not to be relied on (a larger --budget, another "
        "--seed may find a better one)",
        num_held, developed.check.size()));
  }
  if (num_held < kHalf * num_shapes && developed.grasp.digits.size() == 2) {
    for (const std::string& pair : ListPairsApart(hand, developed.grasp.digits)) {
      warnings.push_back(pair);
    }
  }
  const int num_failed = developed.num_numerical_failures;
  if (num_failed > kMostFailures * developed.num_trials) {
    warnings.push_back(fmt::format(
        "{} of {} trials ({:.1f} %) failed numerically and count as not held, so the scores are "
        "too low (look at masses, inertias and drives of the hand)",
        num_failed, developed.num_trials, 100.0 * num_failed / developed.num_trials));
  }
  return warnings;
}

}  // namespace graspbench
