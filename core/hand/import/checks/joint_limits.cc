#include "core/hand/import/checks/joint_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {
namespace {

constexpr double kInch = 0.0254;  // [m]
constexpr double kMostMetres = 0.3, kMostDecimetres = 0.8, kMostInches = 2.5,
                 kMostCentimetres = 9.0, kLeastMillimetres = 14.0, kMostMillimetres = 500.0;
constexpr double kLeastOfSlide = kMostInches;  // no slide of a hand in metres is so far away

/** Median distance of a joint from its parent's frame; 0: no joint counts. */
double CalcTypicalDistance(const ForeignHand& hand) {
  std::vector<double> distances;
  for (const ForeignJoint& joint : hand.joints) {
    const double distance = joint.X_PJ.translation().norm();
    const double least = joint.kind == ForeignJoint::Kind::kPrismatic ? kLeastOfSlide : 1e-9;
    if (joint.kind != ForeignJoint::Kind::kFixed && distance > least) distances.push_back(distance);
  }
  if (distances.empty()) return 0.0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

void Scale(double unit, ForeignHand& hand) {
  for (ForeignJoint& joint : hand.joints) {
    joint.X_PJ.translation() *= unit;
    if (joint.kind == ForeignJoint::Kind::kPrismatic) {
      joint.lower *= unit;
      joint.upper *= unit;
      if (joint.mimic) joint.mimic->offset *= unit;
    }
  }
  for (ForeignLink& link : hand.links) {
    link.X_LF.translation() *= unit;
    if (link.inertia) {
      link.inertia->X_LI.translation() *= unit;
      link.inertia->I_I *= unit * unit;
    }
    for (auto* shapes : {&link.visuals, &link.collisions, &link.weights}) {
      for (ForeignShape& shape : *shapes) {
        shape.X_LS.translation() *= unit;
        shape.size *= unit;
      }
    }
  }
}

}  // namespace

namespace {

/** Returns the unit [m]; 0, with an error reported, if it is unknown. */
double InferUnit(const std::string& file, Diagnostics& problems, const ForeignHand& hand) {
  const double typical = CalcTypicalDistance(hand);
  if (typical < kMostMetres) return 1.0;
  const std::string distance =
      "the joints lie typically " + FormatSignificant(typical, 3) + " apart";
  if (typical > kMostMillimetres || (typical > kMostCentimetres && typical < kLeastMillimetres)) {
    problems.Fail(file, 0,
                  distance +
                      ", which is a hand neither in metres nor in centimetres nor in "
                      "millimetres; say its unit with --unit");
    return 0.0;
  }
  const bool is_decimetre = typical < kMostDecimetres, is_inch = typical < kMostInches,
             is_centimetre = typical < kMostCentimetres;
  const double unit = is_decimetre ? 0.1 : is_inch ? kInch : is_centimetre ? 0.01 : 0.001;
  const auto format = [&](double of) {
    return FormatSignificant(MmFromM(of * typical), 3) + " mm";
  };
  problems.Warn(file, 0,
                distance + ": the description is taken to be in " +
                    (is_decimetre    ? "decimetres"
                     : is_inch       ? "inches"
                     : is_centimetre ? "centimetres"
                                     : "millimetres") +
                    ", where that is " + format(unit) + ", " +
                    (!is_decimetre && is_inch
                         ? "as in a finger; centimetres would be " + format(0.01) + " (--unit cm)"
                     : !is_decimetre && is_centimetre
                         ? "as in a finger; inches would be " + format(kInch) + " (--unit in)"
                         : "as in a finger; if it is not, say its unit with --unit"));
  return unit;
}

}  // namespace

void SetLengthUnit(double unit, const std::string& file, Diagnostics& problems, ForeignHand& hand) {
  if (unit == 0.0) unit = InferUnit(file, problems, hand);
  if (unit == 0.0) return;
  if (unit != 1.0) Scale(unit, hand);
  for (ForeignJoint& joint : hand.joints) {
    if (joint.kind != ForeignJoint::Kind::kPrismatic) continue;
    const std::string repaired = FinishStroke(joint);
    if (!repaired.empty()) {
      problems.Warn(file, joint.line, "joint \"" + joint.name + "\"" + repaired);
    }
  }
}

std::vector<double> CalcLinkLengths(const ForeignHand& hand) {
  std::vector<double> lengths(hand.links.size(), 0.0), own(hand.links.size(), 0.0);
  std::vector<bool> is_end(hand.links.size(), true);
  for (const ForeignJoint& joint : hand.joints) {
    const bool is_slide = joint.kind == ForeignJoint::Kind::kPrismatic;
    const double distance = is_slide ? 0.0 : joint.X_PJ.translation().norm();
    double& length = lengths[static_cast<size_t>(joint.parent)];
    length = std::max(length, distance);
    is_end[static_cast<size_t>(joint.parent)] = false;
    own[static_cast<size_t>(joint.child)] = distance;
  }
  for (size_t i = 0; i < lengths.size(); ++i) {
    if (is_end[i]) lengths[i] = own[i];
  }
  return lengths;
}

namespace {

/** Largest limit of a joint [rad], [m]. */
constexpr double kMostTurn = 2.0 * kPi * (1.0 - 1e-6), kMostStroke = 1.0 - 1e-6;
constexpr double kRounding = 1.0 + 1e-4;
/** Stroke of a joint if it is unknown [m]. */
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
