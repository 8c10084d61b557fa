#include "core/optimise/pregrasp_learning.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/grasp/placement.h"
#include "core/hand/coupling.h"
#include "core/optimise/digit_course.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kFreeRoom = 0.02;    ///< the opening exceeds the width by this [m]
constexpr double kMostOpened = 3.0;   ///< largest l
constexpr double kMostClosed = -0.9;  ///< smallest l
constexpr int kOpeningSteps = 30;

const Digit& FindDigit(const Hand& hand, const std::string& id) {
  const auto digit = std::find_if(hand.digits.begin(), hand.digits.end(),
                                  [&](const Digit& d) { return d.id == id; });
  GRASPBENCH_DEMAND(digit != hand.digits.end(), id);
  return *digit;
}

/** One digit as it can be opened and closed. */
class OpenableDigit {
 public:
  OpenableDigit(const Hand& hand, const GraspObject& object, const Grasp& grasp, const Digit& digit,
                const VectorXd& deviation)
      : hand_(hand), object_(object), grasp_(grasp), digit_(digit), deviation_(deviation) {
    const DigitCourse start = CalcCourse(0.0);
    first_touch_ = largest_touch_ = largest_above_table_ = start.touch;
    if (std::isnan(start.touch)) return;
    const double lowest = std::min(start.lowest, kTableClearance);
    bool is_above_table = true;
    for (int k = 1; k <= kOpeningSteps; ++k) {
      const double opened = kMostOpened * k / kOpeningSteps;
      const DigitCourse course = CalcCourse(opened);
      if (std::isnan(course.touch)) break;
      is_above_table = is_above_table && course.lowest >= lowest;
      if (is_above_table) largest_above_table_ = std::max(largest_above_table_, course.touch);
      if (course.touch <= largest_touch_) continue;
      largest_touch_ = course.touch;
      most_opened_ = opened;
    }
  }

  double first_touch() const { return first_touch_; }      ///< s from the old pre-grasp
  double largest_touch() const { return largest_touch_; }  ///< s when opened as far as it can be
  double largest_above_table() const { return largest_above_table_; }

  /** Puts into `q` the joints of the digit from which it touches at s. */
  void Open(double s, VectorXd& q) const {
    double low = kMostClosed, high = most_opened_;
    constexpr int kHalvings = 20;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      const double touch = CalcCourse(middle).touch;
      (std::isnan(touch) || touch >= s ? high : low) = middle;
    }
    PutOpened(high, q);
  }

 private:
  void PutOpened(double opened, VectorXd& q) const {
    for (const int joint : FindDrivenJoints(hand_, digit_)) {
      const HandJoint& limits = hand_.joints[static_cast<size_t>(joint)];
      const double wanted =
          grasp_.q_pre[joint] - opened * (grasp_.q_target[joint] - grasp_.q_pre[joint]);
      q[joint] = std::clamp(wanted, limits.lower, limits.upper);
    }
    ApplyCoupling(hand_, q);
  }

  DigitCourse CalcCourse(double opened) const {
    VectorXd q = grasp_.q_pre;
    PutOpened(opened, q);
    return CalcDigitCourse(hand_, object_, grasp_, digit_, q, deviation_);
  }

  const Hand& hand_;
  const GraspObject& object_;
  const Grasp& grasp_;
  const Digit& digit_;
  const VectorXd& deviation_;
  double first_touch_, largest_touch_, largest_above_table_;
  double most_opened_ = 0.0;  // the l of largest_touch_
};

/** Of a digit that comes to the object at `touch` from the old pre-grasp. */
DigitCase FindCase(double touch) {
  if (std::isnan(touch)) return DigitCase::kNeverTouched;
  return touch > 0.0 ? DigitCase::kLearned : DigitCase::kTouchedAtOnce;
}

}  // namespace

double CalcOpening(const Hand& hand, const Grasp& grasp, const VectorXd& q) {
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

std::vector<VectorXd> CalcDeviations(const Hand& hand, const Grasp& grasp,
                                     const std::vector<double>& closings,
                                     const std::vector<VectorXd>& q) {
  GRASPBENCH_DEMAND(closings.size() == grasp.digits.size(), std::to_string(closings.size()));
  GRASPBENCH_DEMAND(q.size() == grasp.digits.size(), std::to_string(q.size()));
  std::vector<VectorXd> deviations(q.size(), VectorXd::Zero(hand.num_joints()));
  for (size_t d = 0; d < q.size(); ++d) {
    if (q[d].size() == 0) continue;
    const VectorXd q_commanded = CalcClosingPosture(hand, grasp, closings[d]);
    for (int j = 0; j < hand.num_joints(); ++j) {
      const int digit = hand.FindDigitOfLink(hand.joints[static_cast<size_t>(j)].link);
      if (digit < 0 || hand.digits[static_cast<size_t>(digit)].id != grasp.digits[d]) continue;
      deviations[d][j] = q[d][j] - q_commanded[j];
    }
  }
  return deviations;
}

LearnedPreGrasp LearnPreGrasp(const Hand& hand, const GraspObject& object, const Grasp& grasp,
                              const std::vector<VectorXd>& deviations, PreGraspWidth width) {
  GRASPBENCH_DEMAND(deviations.size() == grasp.digits.size(), std::to_string(deviations.size()));
  LearnedPreGrasp result;
  result.q_pre = grasp.q_pre;
  result.opening = CalcOpening(hand, grasp, grasp.q_pre);
  result.required_opening = result.opening;

  std::vector<OpenableDigit> digits;
  double first = kLargestCommonClosing, above_table = first, widest = first;
  for (size_t d = 0; d < deviations.size(); ++d) {
    const OpenableDigit digit(hand, object, grasp, FindDigit(hand, grasp.digits[d]), deviations[d]);
    result.digit_cases.push_back(FindCase(digit.first_touch()));
    if (result.digit_cases.back() == DigitCase::kNeverTouched) continue;
    first = std::min(first, digit.first_touch());
    above_table = std::min(above_table, digit.largest_above_table());
    widest = std::min(widest, digit.largest_touch());
    digits.push_back(digit);
  }
  result.common_closing = width == PreGraspWidth::kWidest       ? widest
                          : width == PreGraspWidth::kAboveTable ? above_table
                                                                : 0.5 * (above_table + first);
  if (digits.size() < 2 || result.common_closing <= 0.0) return result;

  VectorXd wanted = grasp.q_pre;
  for (const OpenableDigit& digit : digits) digit.Open(result.common_closing, wanted);
  VectorXd touching = wanted + result.common_closing * (grasp.q_target - wanted);
  ApplyCoupling(hand, touching);
  result.required_opening =
      std::min(CalcOpening(hand, grasp, touching) + kFreeRoom, result.opening);
  const double opening = CalcOpening(hand, grasp, wanted);
  if (opening < result.required_opening) return result;
  result.is_new = true;
  result.q_pre = wanted;
  result.opening = opening;
  return result;
}

}  // namespace graspbench
