#include "core/optimise/pregrasp_learning.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/contact_timing.h"
#include "core/grasp/placement.h"
#include "core/hand/hand.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kFreeRoom = 0.02;    ///< excess of the opening over the width [m]
constexpr double kMostOpened = 3.0;   ///< largest l
constexpr double kMostClosed = -0.9;  ///< smallest l
constexpr int kOpeningSteps = 30;

constexpr int kSteps = 100;

struct DigitPlace {
  double gap = std::numeric_limits<double>::infinity();     ///< from the object [m]
  double lowest = std::numeric_limits<double>::infinity();  ///< height above the table [m]
};

DigitPlace CalcPlace(const Hand& hand, const GraspObject& object, const Pose& X_WH,
                     const Digit& digit, const VectorXd& q) {
  // As the object rests: frame O above the origin of W, axes parallel (placement.h).
  const Vector3d p_WO(0.0, 0.0, 0.5 * object.size.z());
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  DigitPlace place;
  for (const ContactSphere& sphere : hand.contact_spheres) {
    if (!std::count(digit.links.begin(), digit.links.end(), sphere.link)) continue;
    const Vector3d p_WS = X_WH * (X_HL[sphere.link] * sphere.p_LS);
    place.gap = std::min(place.gap, object.field->CalcDistance(p_WS - p_WO) - sphere.radius);
    place.lowest = std::min(place.lowest, p_WS.z() - sphere.radius);
  }
  return place;
}

const Digit& FindDigit(const Hand& hand, const std::string& id) {
  const auto digit = std::find_if(hand.digits.begin(), hand.digits.end(),
                                  [&](const Digit& d) { return d.id == id; });
  GRASPBENCH_DEMAND(digit != hand.digits.end(), id);
  return *digit;
}

/** One digit, to be opened and closed. */
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
  double largest_touch() const { return largest_touch_; }  ///< s when opened as far as possible
  double largest_above_table() const { return largest_above_table_; }

  /** Sets the joints of the digit in `q` such that it touches at s. */
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
      const HandJoint& limits = hand_.joints[joint];
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

/** Case of a digit that reaches the object at `touch` from the old pre-grasp. */
DigitCase FindCase(double touch) {
  if (std::isnan(touch)) return DigitCase::kNeverTouched;
  return touch > 0.0 ? DigitCase::kLearned : DigitCase::kTouchedAtOnce;
}

}  // namespace

DigitCourse CalcDigitCourse(const Hand& hand, const GraspObject& object, const Grasp& grasp,
                            const Digit& digit, const VectorXd& q_pre, const VectorXd& deviation) {
  GRASPBENCH_DEMAND(grasp.placement, grasp.id);
  DigitCourse course;
  course.lowest = std::numeric_limits<double>::infinity();
  double last_gap = 0.0;
  for (int k = 0; k <= kSteps; ++k) {
    const double s = static_cast<double>(k) / kSteps;
    VectorXd q = q_pre + s * (grasp.q_target - q_pre);
    ApplyCoupling(hand, q);
    const DigitPlace place = CalcPlace(hand, object, grasp.placement->X_WH, digit, q + deviation);
    course.lowest = std::min(course.lowest, place.lowest);
    if (place.gap <= 0.0) {
      // The gap changes linearly between two steps.
      course.touch = k == 0 ? 0.0 : s + place.gap / (last_gap - place.gap) / kSteps;
      return course;
    }
    last_gap = place.gap;
  }
  return course;
}

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
      const int digit = hand.FindDigitOfLink(hand.joints[j].link);
      if (digit < 0 || hand.digits[digit].id != grasp.digits[d]) continue;
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

std::map<std::string, ClosingSchedule> LearnDelays(const Grasp& grasp,
                                                   const std::vector<LearningTrial>& trials,
                                                   double gain) {
  const std::vector<double> medians = CalcMedianTimes(ListContacts(trials));
  double latest = -HUGE_VAL, least = HUGE_VAL;
  for (const double median : medians) {
    if (!std::isnan(median)) latest = std::max(latest, median);
  }
  std::map<std::string, ClosingSchedule> closing;
  for (size_t d = 0; d < grasp.digits.size(); ++d) {
    const auto own = grasp.closing.find(grasp.digits[d]);
    ClosingSchedule schedule = own == grasp.closing.end() ? ClosingSchedule() : own->second;
    const double median = d < medians.size() ? medians[d] : kUnset;
    if (!std::isnan(median)) schedule.delay += gain * (latest - median);
    least = std::min(least, schedule.delay);
    closing[grasp.digits[d]] = schedule;
  }
  for (auto it = closing.begin(); it != closing.end();) {
    it->second.delay -= least;
    it = it->second == ClosingSchedule() ? closing.erase(it) : std::next(it);
  }
  return closing;
}

std::string DescribeDelays(const Grasp& grasp) {
  std::string text;
  for (const std::string& digit : grasp.digits) {
    const auto own = grasp.closing.find(digit);
    if (own == grasp.closing.end() || own->second.delay <= 0.0) continue;
    text += (text.empty() ? digit + " waits " : ", " + digit + " ") +
            FormatFixed(MsFromS(own->second.delay), 0) + " ms";
  }
  return text;
}

}  // namespace graspbench
