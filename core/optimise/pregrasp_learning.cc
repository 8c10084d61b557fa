#include "core/optimise/pregrasp_learning.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/hand/coupling.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kFreeRoom = 0.02;  ///< the opening exceeds the width by this [m]

const Digit& FindDigit(const Hand& hand, const std::string& id) {
  const auto digit = std::find_if(hand.digits.begin(), hand.digits.end(),
                                  [&](const Digit& d) { return d.id == id; });
  GRASPBENCH_DEMAND(digit != hand.digits.end(), id);
  return *digit;
}

DigitCase FindCase(double closing) {
  if (std::isnan(closing)) return DigitCase::kNeverTouched;
  return closing > 0.0 ? DigitCase::kLearned : DigitCase::kTouchedAtOnce;
}

/** The largest s* for which the joints of a digit that touched at `closing` stay within limits:
1 - s* >= stroke (1 - s_i) / room, where room is what lies between target and limit. */
double CalcLargestClosing(const Hand& hand, const StandardGrasp& grasp, const Digit& digit,
                          double closing) {
  double largest = kLargestCommonClosing;
  for (const int joint : FindDrivenJoints(hand, digit)) {
    const double stroke = grasp.q_target[joint] - grasp.q_pre[joint];
    const HandJoint& limits = hand.joints[static_cast<size_t>(joint)];
    const double room =
        stroke > 0.0 ? grasp.q_target[joint] - limits.lower : limits.upper - grasp.q_target[joint];
    if (stroke == 0.0 || room <= 0.0) continue;
    largest = std::min(largest, 1.0 - std::abs(stroke) * (1.0 - closing) / room);
  }
  return largest;
}

}  // namespace

const char* NameOf(DigitCase digit_case) {
  switch (digit_case) {
    case DigitCase::kLearned:
      return "learned";
    case DigitCase::kNeverTouched:
      return "never touched";
    case DigitCase::kTouchedAtOnce:
      return "touched at once";
  }
  return "";
}

double CalcOpening(const Hand& hand, const StandardGrasp& grasp, const VectorXd& q) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  const std::string& opposing = hand.digits[FindOpposingDigit(hand, grasp)].id;
  Vector3d p_HThumb = Vector3d::Zero(), p_HFingers = Vector3d::Zero();
  for (const std::string& id : grasp.digits) {
    const Digit& digit = FindDigit(hand, id);
    const Vector3d p_HPad = X_HL[digit.distal_link] * digit.p_LPad;
    if (id == opposing) {
      p_HThumb = p_HPad;
    } else {
      p_HFingers += p_HPad / static_cast<double>(grasp.digits.size() - 1);
    }
  }
  return (p_HThumb - p_HFingers).norm();
}

LearnedPreGrasp LearnPreGrasp(const Hand& hand, const StandardGrasp& grasp,
                              const std::vector<double>& closings) {
  GRASPBENCH_DEMAND(closings.size() == grasp.digits.size(), std::to_string(closings.size()));
  LearnedPreGrasp result;
  result.q_pre = grasp.q_pre;
  result.opening = CalcOpening(hand, grasp, grasp.q_pre);
  result.required_opening = result.opening;
  for (const double closing : closings) result.digit_cases.push_back(FindCase(closing));
  if (std::count(result.digit_cases.begin(), result.digit_cases.end(), DigitCase::kLearned) < 2) {
    return result;
  }

  double common = kLargestCommonClosing;
  for (size_t d = 0; d < closings.size(); ++d) {
    if (result.digit_cases[d] != DigitCase::kLearned) continue;
    common = std::min(common, CalcLargestClosing(hand, grasp, FindDigit(hand, grasp.digits[d]),
                                                 std::min(closings[d], 1.0)));
  }
  // A joint can stand beyond its limit by rounding only; then there is nothing to open.
  result.common_closing = std::max(common, 0.0);

  VectorXd wanted = grasp.q_pre, touching = grasp.q_target;
  for (size_t d = 0; d < closings.size(); ++d) {
    if (result.digit_cases[d] == DigitCase::kNeverTouched) continue;
    const double closing = std::clamp(closings[d], 0.0, 1.0);
    for (const int joint : FindDrivenJoints(hand, FindDigit(hand, grasp.digits[d]))) {
      const double target = grasp.q_target[joint];
      const double contact = grasp.q_pre[joint] + closing * (target - grasp.q_pre[joint]);
      touching[joint] = contact;
      const HandJoint& limits = hand.joints[static_cast<size_t>(joint)];
      wanted[joint] =
          std::clamp((contact - result.common_closing * target) / (1.0 - result.common_closing),
                     limits.lower, limits.upper);
    }
  }

  ApplyCoupling(hand, touching);
  const double width = CalcOpening(hand, grasp, touching);
  result.required_opening = std::min(width + kFreeRoom, result.opening);

  constexpr int kShares = 100;
  for (int k = kShares; k >= 0; --k) {
    result.share = static_cast<double>(k) / kShares;
    result.q_pre = grasp.q_pre + result.share * (wanted - grasp.q_pre);
    ApplyCoupling(hand, result.q_pre);
    result.opening = CalcOpening(hand, grasp, result.q_pre);
    if (result.opening >= result.required_opening) break;
  }
  return result;
}

}  // namespace graspbench
