#include "core/hand/import/checks/joint_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text/text.h"
#include "core/hand/import/fix_joint.h"

namespace graspbench {
namespace {

/** What a joint gets at most [rad], [m]. */
constexpr double kMostTurn = 2.0 * kPi * (1.0 - 1e-6), kMostStroke = 1.0 - 1e-6;
constexpr double kRounding = 1.0 + 1e-4;
/** Of a joint whose stroke nobody knows [m]. */
constexpr double kGuessedStroke = 0.05;

}  // namespace

std::string SetLimits(const StatedLimits& stated, ForeignJoint& joint) {
  const bool slides = joint.kind == ForeignJoint::Kind::kPrismatic;
  const double most = slides ? std::numeric_limits<double>::infinity() : kMostTurn;
  joint.lower = slides ? 0.0 : -kPi;
  joint.upper = slides ? 0.0 : kPi;
  if (!stated.missing.empty()) {
    joint.no_limits = "has no " + stated.missing;
    return "";
  }
  const double largest = std::max(std::abs(stated.lower), std::abs(stated.upper));
  if (largest > most * kRounding) {
    joint.no_limits = "has a limit of " + FormatSignificant(largest, 3) + ", more than one turn";
    return "";
  }
  if (stated.lower == stated.upper) {
    joint.no_limits = "has equal limits";
    joint.lower = joint.upper = stated.lower;
    return "";
  }
  joint.lower = std::clamp(std::min(stated.lower, stated.upper), -most, most);
  joint.upper = std::clamp(std::max(stated.lower, stated.upper), -most, most);
  return stated.lower > stated.upper ? ": the limits are reversed; exchanged" : "";
}

void FixUnlimited(const std::string& file, Diagnostics& problems, ForeignHand& hand) {
  for (size_t j = 0; j < hand.joints.size(); ++j) {
    ForeignJoint& joint = hand.joints[j];
    if (joint.no_limits.empty() || joint.kind == ForeignJoint::Kind::kFixed) continue;
    const auto warn = [&](const std::string& text) {
      problems.Warn(file, joint.line, "joint \"" + joint.name + "\" " + joint.no_limits + text);
    };
    const ForeignJoint* leader =
        joint.mimic ? &hand.joints[static_cast<size_t>(joint.mimic->joint)] : nullptr;
    if (leader && leader->no_limits.empty() && !joint.mimic->is_distal) {
      const double ends[] = {joint.mimic->offset + joint.mimic->ratio * leader->lower,
                             joint.mimic->offset + joint.mimic->ratio * leader->upper};
      joint.lower = std::min(ends[0], ends[1]);
      joint.upper = std::max(ends[0], ends[1]);
      warn("; as far as \"" + leader->name + "\" takes it");
    } else if (!leader) {
      const double at = joint.lower == joint.upper ? joint.lower : 0.0;
      warn("; fixed: give it a lower and an upper limit if it moves");
      FixJoint(hand, static_cast<int>(j), at);
    }
  }
}

void StatedAngles::Add(double lower, double upper, double unit, int line) {
  if (num_joints++ == 0) first_line = line;
  const double most = std::max(std::abs(lower), std::abs(upper));
  largest = std::max(largest, most);
  num_beyond_turn += unit * std::max(most, upper - lower) > kWholeTurn;
}

std::string StatedAngles::FindDoubt(bool in_degrees) const {
  const std::string count = FormatCount(num_joints, "joint");
  const std::string most = FormatSignificant(largest, 3);
  if (in_degrees && num_joints > 1 && largest < kWholeTurn) {
    return "no range of " + count + " goes beyond " + most +
           "; taken as degrees, as MuJoCo does unless <compiler> says otherwise; if they are "
           "radians, say --angle rad";
  }
  if (!in_degrees && num_beyond_turn > 0) {
    return "the ranges of " + std::to_string(num_beyond_turn) + " of " + count +
           " go beyond one turn, up to " + most +
           "; taken as radians, as <compiler> says; if they are degrees, say --angle deg";
  }
  return "";
}

std::string FinishStroke(ForeignJoint& joint) {
  const bool is_missing = joint.lower == joint.upper;
  const double largest = std::max(std::abs(joint.lower), std::abs(joint.upper));
  if (is_missing || largest > kMostStroke * kRounding) {
    joint.lower = 0.0;
    joint.upper = kGuessedStroke;
    return is_missing ? "" : ": a limit exceeds 1 m; taken as 0 to 50 mm";
  }
  joint.lower = std::max(joint.lower, -kMostStroke);
  joint.upper = std::min(joint.upper, kMostStroke);
  return "";
}

}  // namespace graspbench
