#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/develop/hand_pads.h"
#include "core/grasp/placement.h"
#include "core/transfer/transfer_grasp.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kFarthestMarker = 0.03;  ///< distance of a touching digit from the surface [m]
constexpr double kOutOfOrder = 0.005;     ///< of neighbouring fingers along their row [m]
constexpr double kWorseOpposition = 0.5;  ///< of the thumb relative to another digit, cosine
constexpr double kShortestPhalanx = 0.01, kLongestPhalanx = 0.05;  ///< human last phalanx [m]
constexpr double kFlat = 0.1;  ///< least volume that distinguishes left and right, share of a cube

std::vector<Vector3d> ListPlaces(const std::vector<PersonDigit>& digits) {
  std::vector<Vector3d> places;
  for (const PersonDigit& digit : digits) places.push_back(digit.p_O);
  return places;
}

/** Mean of all positions but the first. */
Vector3d CalcFingersMiddle(const std::vector<Vector3d>& places) {
  Vector3d middle = Vector3d::Zero();
  for (size_t d = 1; d < places.size(); ++d) {
    middle += places[d] / static_cast<double>(places.size() - 1);
  }
  return middle;
}

/** -1: right hand, from the first and last finger, the thumb, and the palm or wrist behind them. */
int CalcHandedness(const Vector3d& p_Thumb, const Vector3d& p_First, const Vector3d& p_Last,
                   const Vector3d& p_Palm) {
  const Vector3d middle = 0.5 * (p_First + p_Last);
  const Vector3d row = p_Last - p_First, across = p_Thumb - middle;
  const Vector3d back = p_Palm - 0.5 * (middle + p_Thumb);
  const double volume = row.normalized().dot(across.normalized().cross(back.normalized()));
  return std::abs(volume) < kFlat ? 0 : volume > 0.0 ? 1 : -1;
}

/** Fingers of the hand in order. */
std::vector<int> ListFingers(const Hand& hand) {
  std::vector<int> fingers;
  for (int d = 0; d < static_cast<int>(hand.digits.size()); ++d) {
    if (!hand.digits[static_cast<size_t>(d)].is_thumb) fingers.push_back(d);
  }
  return fingers;
}

/** The digit in the role of the thumb: the first if there is none. */
int FindThumbOf(const Hand& hand) {
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    if (hand.digits[d].is_thumb) return static_cast<int>(d);
  }
  return 0;
}

PadGoal MakeGoal(int digit, const std::vector<PersonDigit>& people, const GraspObject& object) {
  PadGoal goal;
  goal.digit = digit;
  const auto count = static_cast<double>(people.size());
  goal.is_direction_measured = true;
  for (const PersonDigit& person : people) {
    goal.person += (goal.person.empty() ? "" : "+") + person.digit;
    const SignedDistanceField::Sample near = object.field->Query(person.p_O);
    goal.p_O += (person.p_O - near.distance * near.gradient) / count;
    goal.opening_O += person.opening_O / count;
    goal.nhat_O += person.nhat_O;
    goal.axis_O += person.axis_O;
    if (person.nhat_O.isZero(0.0)) goal.is_direction_measured = false;
  }
  constexpr int kSteps = 4;  // on a curved surface the mean of its points is inside
  SignedDistanceField::Sample near;
  for (int k = 0; k < kSteps; ++k) {
    near = object.field->Query(goal.p_O);
    goal.p_O -= near.distance * near.gradient;
  }
  if (!goal.is_direction_measured) goal.nhat_O = -near.gradient;
  goal.nhat_O.normalize();
  goal.axis_O.normalize();  // zero stays zero
  return goal;
}

}  // namespace

Vector3d CalcOpeningAxis(const std::vector<Vector3d>& p_OTips) {
  return CalcFingersMiddle(p_OTips) - p_OTips.front();
}

std::vector<Vector3d> CalcDigitOpenings(const std::vector<Vector3d>& p_OTips,
                                        const std::vector<Vector3d>& p_OContact) {
  GRASPBENCH_DEMAND(p_OContact.size() >= 2 && p_OTips.size() == p_OContact.size(),
                    std::to_string(p_OTips.size()));
  const Vector3d met = CalcFingersMiddle(p_OContact), was = CalcFingersMiddle(p_OTips);
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(was - p_OTips[0], met - p_OContact[0]);
  const Vector3d middle = 0.5 * (was + p_OTips[0]), to = 0.5 * (met + p_OContact[0]);
  std::vector<Vector3d> openings;
  for (size_t d = 0; d < p_OTips.size(); ++d) {
    openings.emplace_back(to + turn * (p_OTips[d] - middle) - p_OContact[d]);
  }
  return openings;
}

void SetOpening(const std::vector<Vector3d>& p_OOpen, PersonGrasp& person) {
  const std::vector<Vector3d> openings = CalcDigitOpenings(p_OOpen, ListPlaces(person.digits));
  for (size_t d = 0; d < openings.size(); ++d) person.digits[d].opening_O = openings[d];
}

PersonGrasp UseLandmarks(const PersonGrasp& person, const GraspObject& object) {
  constexpr double kStraight =
      0.17;                        // sine of the bends, in sum: below it their plane is not known
  constexpr int kSteps = 20;       // each by the distance from the surface
  constexpr double kMet = 0.0005;  // distance that counts as contact [m]
  PersonGrasp used = person;
  for (PersonDigit& digit : used.digits) {
    if (digit.p_OJoints.empty()) continue;
    std::vector<Vector3d> chain = digit.p_OJoints;
    chain.push_back(digit.p_O);
    const Vector3d last = digit.p_O - digit.p_OJoints.back();
    digit.axis_O = last.normalized();
    digit.p_O -= kPadShare * last;
    Vector3d bend = Vector3d::Zero();  // about this axis, away from the palmar side
    for (size_t k = 0; k + 2 < chain.size(); ++k) {
      const Vector3d bone = (chain[k + 1] - chain[k]).normalized();
      bend += bone.cross((chain[k + 2] - chain[k + 1]).normalized());
    }
    const Vector3d inwards = -object.field->Query(digit.p_O).gradient;
    Vector3d across = bend.cross(digit.axis_O);
    if (bend.norm() < kStraight) across = inwards - inwards.dot(digit.axis_O) * digit.axis_O;
    if (across.norm() < kStraight) continue;  // the tip points at the surface
    digit.nhat_O = (across.dot(inwards) < 0.0 ? -across : across).normalized();
    Vector3d met = digit.p_O;
    for (int k = 0; k < kSteps && (met - digit.p_O).norm() < kFarthestPad; ++k) {
      met += object.field->Query(met).distance * digit.nhat_O;
    }
    if (std::abs(object.field->Query(met).distance) < kMet) digit.p_O = met;
  }
  return used;
}

std::string FindPersonFault(const PersonGrasp& person, const GraspObject& object) {
  const std::vector<PersonDigit>& digits = person.digits;
  if (digits.size() < 2 || digits[0].digit != "TH") {
    return "thumb and another digit must touch, and " +
           (digits.empty() ? std::string("none does") : "the first is " + digits[0].digit);
  }
  std::vector<Vector3d> normals;
  for (const PersonDigit& digit : digits) {
    const SignedDistanceField::Sample near = object.field->Query(digit.p_O);
    if (!(std::abs(near.distance) <= kFarthestMarker)) {
      return digit.digit + " is " + FormatFixed(MmFromM(near.distance), 0) +
             " mm from the object's surface at contact, at most 30 mm are expected: check the unit "
             "of length, the object's pose and size, and whether both are of this trial";
    }
    normals.push_back(near.gradient);
    if (digit.p_OJoints.empty()) continue;
    const double last = (digit.p_O - digit.p_OJoints.back()).norm();
    if (last < kShortestPhalanx || last > kLongestPhalanx) {
      return "the last joint of " + digit.digit + " is " + FormatFixed(MmFromM(last), 0) +
             " mm from its tip, 10 to 50 mm are expected: check the order of markers.joints and "
             "whether they are of this digit";
    }
  }
  if (digits.size() < 3) return "";
  const Vector3d row = digits.back().p_O - digits[1].p_O;
  for (size_t d = 1; d + 1 < digits.size(); ++d) {
    const double step = (digits[d + 1].p_O - digits[d].p_O).dot(row.normalized());
    if (step < -kOutOfOrder) {
      return digits[d].digit + " and " + digits[d + 1].digit +
             " lie in the reverse order along the row of fingers: are their markers exchanged?";
    }
  }
  const auto calc_opposition = [&](size_t d) {
    double opposition = 0.0;
    for (size_t other = 0; other < digits.size(); ++other) {
      if (other != d) opposition -= normals[d].dot(normals[other]);
    }
    return opposition / static_cast<double>(digits.size() - 1);
  };
  for (size_t d = 1; d < digits.size(); ++d) {
    if (calc_opposition(d) > calc_opposition(0) + kWorseOpposition) {
      return digits[d].digit +
             " opposes the other digits, and the thumb does not: are their markers exchanged?";
    }
  }
  return "";
}

int FindHandedness(const PersonGrasp& person) {
  if (!person.p_OPalm || person.digits.size() < 3) return 0;
  return CalcHandedness(person.digits[0].p_O, person.digits[1].p_O, person.digits.back().p_O,
                        *person.p_OPalm);
}

int FindHandedness(const Hand& hand, const Grasp& standard) {
  const std::vector<int> fingers = ListFingers(hand);
  const int thumb = FindThumbOf(hand);
  if (fingers.size() < 2 || !hand.digits[static_cast<size_t>(thumb)].is_thumb) return 0;
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, CalcClosingPosture(hand, standard, 0.5));
  const auto calc_pad = [&](int digit) {
    return CalcPadState(hand, hand.digits[static_cast<size_t>(digit)], X_HL).p_HPad;
  };
  return CalcHandedness(calc_pad(thumb), calc_pad(fingers.front()), calc_pad(fingers.back()),
                        hand.p_HCentre);
}

std::vector<PadGoal> PairDigits(const Hand& hand, const PersonGrasp& person,
                                const GraspObject& object, bool reverse) {
  const int thumb = FindThumbOf(hand);
  std::vector<int> fingers = ListFingers(hand);
  fingers.erase(std::remove(fingers.begin(), fingers.end(), thumb), fingers.end());
  if (reverse) std::reverse(fingers.begin(), fingers.end());
  const std::vector<PersonDigit>& digits = person.digits;
  std::vector<PadGoal> goals = {MakeGoal(thumb, {digits[0]}, object)};
  const size_t num_used = std::min(fingers.size(), digits.size() - 1);
  for (size_t f = 0; f < num_used; ++f) {
    const auto first = digits.begin() + 1 + static_cast<std::ptrdiff_t>(f);
    goals.push_back(
        MakeGoal(fingers[f], {first, f + 1 == num_used ? digits.end() : first + 1}, object));
  }
  return goals;
}

}  // namespace graspbench
