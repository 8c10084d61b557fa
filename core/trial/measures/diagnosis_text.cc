#include "core/trial/measures/diagnosis_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

constexpr double kPressedDown = 1.5;  // share of the weight that the table bears

std::string FormatSeconds(double time) { return FormatFixed(time, 3) + " s"; }
std::string FormatNewtons(double force) { return FormatFixed(force, force < 0.1 ? 3 : 2) + " N"; }
std::string FormatWork(double work) { return FormatFixed(1e3 * work, 2) + " mJ"; }
std::string FormatShift(double shift) { return FormatFixed(MmFromM(shift), 1) + " mm"; }

/** "during closure at 1.850 s". */
std::string DescribeTime(const Diagnosis& diagnosis) {
  return fmt::format("during {} at {}", diagnosis.phase, FormatSeconds(diagnosis.time));
}

/** "All digits touched within 10 ms.", or names those that did not touch. Touches during placing or
lift only have no time. */
std::string DescribeTouches(const TrialResult& result) {
  std::string touched, untouched;
  int num_touched = 0;
  double first = kUnset, last = kUnset;
  for (const DigitContact& contact : result.contacts) {
    const bool has_touched = !std::isnan(contact.time);
    std::string& names = has_touched ? touched : untouched;
    names += (names.empty() ? "" : ", ") + contact.digit.str();
    num_touched += has_touched ? 1 : 0;
    first = std::fmin(first, contact.time);
    last = std::fmax(last, contact.time);
  }
  if (num_touched == 0) return "No digit touched during closure.";
  const std::string spread = FormatFixed(MsFromS(last - first), 0) + " ms";
  if (untouched.empty()) return "All digits touched within " + spread + ".";
  if (num_touched == 1) return "Only " + touched + " touched during closure.";
  return fmt::format("{} did not touch during closure; the others touched within {}.", untouched,
                     spread);
}

/** "Peak normal forces: TH 2.00 N, FF 1.00 N." */
std::string DescribeForces(const Diagnosis& diagnosis) {
  std::string text;
  for (const PartWork& part : diagnosis.parts) {
    text += (text.empty() ? "" : ", ") + part.part + " " + FormatNewtons(part.force);
  }
  return text.empty() ? "Nothing pressed on the object." : "Peak normal forces: " + text + ".";
}

std::string DescribeWorks(const Diagnosis& diagnosis) {
  return fmt::format(" Work relative to the hand: normal forces {}, gravity {}, friction {}.",
                     FormatWork(diagnosis.CalcNormalWork()), FormatWork(diagnosis.gravity_work),
                     FormatWork(diagnosis.CalcFrictionWork()));
}

std::string DescribeTable(const Diagnosis& diagnosis) {
  return diagnosis.table_share < kPressedDown
             ? fmt::format("The table bore {} % of the object weight.",
                           FormatFixed(100.0 * diagnosis.table_share, 0))
             : fmt::format(
                   "The hand pressed the object onto the table, which bore {} times its weight.",
                   FormatFixed(diagnosis.table_share, 1));
}

/** Digits that missed their setpoint, with the reason. */
std::string DescribeWeakDigits(const TrialResult& result) {
  std::string weak;
  if (!result.grip) return weak;
  for (const DigitGripRecord& digit : result.grip->digits) {
    const bool is_short = digit.closed < (1.0 - kGripTolerance) * digit.asked;  // no force: false
    if (!is_short || digit.fault == GripFault::kNone) continue;
    weak += fmt::format("{}{} {} of {} ({}{})", weak.empty() ? "" : ", ", digit.digit,
                        FormatNewtons(digit.closed), FormatNewtons(digit.asked),
                        NameOf(digit.fault), digit.joint ? " of " + *digit.joint : "");
  }
  return weak.empty() ? weak
                      : " Digits below their setpoint at the start of lift-off: " + weak + ".";
}

std::string DescribeMissing(const TrialResult& result, const Diagnosis& diagnosis) {
  std::string nearest;
  // A record that was read in brief has no touches.
  for (size_t digit = 0; digit < std::min(result.contacts.size(), result.touches.size()); ++digit) {
    const double gap = result.touches[digit].smallest_gap;
    if (result.contacts[digit].digit.str() != diagnosis.part || std::isnan(gap)) continue;
    nearest = fmt::format(" The smallest gap of {} was {}.", diagnosis.part, FormatShift(gap));
  }
  return "Not reached: no two parts of the hand opposed each other. " + DescribeTouches(result) +
         nearest;
}

}  // namespace

std::string DescribeDiagnosis(const TrialResult& result) {
  if (!result.diagnosis) return "";
  const Diagnosis& found = *result.diagnosis;
  const std::string time = DescribeTime(found);
  switch (found.mechanism) {
    case Mechanism::kArmAtLimit:
      return fmt::format("The arm gave way at {}, at {}.",
                         found.joint.empty() ? "its limit" : "the limit of joint " + found.joint,
                         FormatSeconds(found.time));
    case Mechanism::kOutsidePush:
      return fmt::format(
          "Something other than hand, table and gravity pushed the object with {} at {}.",
          FormatNewtons(found.push), FormatSeconds(found.time));
    case Mechanism::kPushed:
      return fmt::format(
          "{} touched the object {} and pushed it by more than 5 mm before two parts of the hand "
          "opposed each other. {}",
          found.part, time, DescribeTouches(result));
    case Mechanism::kNotReached:
      return DescribeMissing(result, found);
    case Mechanism::kDriveAtLimit:
      return fmt::format("Lost {}: {} was at its limit. {}", time,
                         found.joint.empty() ? "a drive of " + found.part
                                             : "the drive of " + found.joint + " of " + found.part,
                         DescribeForces(found)) +
             DescribeWorks(found);
    case Mechanism::kSqueezedOut:
      return fmt::format(
                 "Squeezed out {}. {} The object had moved by {} before two parts of the hand "
                 "opposed each other. {} {}",
                 time, DescribeTouches(result), FormatShift(found.shift), DescribeForces(found),
                 DescribeTable(found)) +
             DescribeWorks(found) + DescribeWeakDigits(result);
    case Mechanism::kSagged:
      return fmt::format("Sagged {}: the object turned by {} degrees in the hand. {} {}", time,
                         FormatFixed(DegFromRad(found.turn), 0), DescribeForces(found),
                         DescribeTouches(result)) +
             DescribeWorks(found) + DescribeWeakDigits(result);
    case Mechanism::kSlid:
      return fmt::format("Slid out {}: the object turned by {} degrees in the hand. {} {}", time,
                         FormatFixed(DegFromRad(found.turn), 0), DescribeForces(found),
                         DescribeTouches(result)) +
             DescribeWorks(found) + DescribeWeakDigits(result);
    case Mechanism::kNotIdentified:
      break;
  }
  return fmt::format("Lost {}; the cause was not identified. {} {}", time, DescribeForces(found),
                     DescribeTable(found)) +
         DescribeWorks(found) + DescribeWeakDigits(result);
}

}  // namespace graspbench
