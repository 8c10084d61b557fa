#include "core/hand/import/shapes/length_unit_guess.h"

#include <algorithm>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/import/checks/joint_limits.h"

namespace graspbench {
namespace {

constexpr double kInch = 0.0254;  // [m]
constexpr double kMostMetres = 0.3, kMostDecimetres = 0.8, kMostInches = 2.5,
                 kMostCentimetres = 9.0, kLeastMillimetres = 14.0, kMostMillimetres = 500.0;
constexpr double kLeastOfSlide = kMostInches;  // no slide of a hand in metres lies so far away

/** The median distance of a joint from the frame it hangs on; 0: none says anything. */
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

/** [m]; 0, with an error reported: nobody knows. */
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

}  // namespace graspbench
