#include "core/grasp/posture_yaml.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/text/yaml_text.h"
#include "core/hand/coupling.h"

namespace graspbench {

void ReadPosture(const Hand& hand, const YAML::Node& node, const std::string& file,
                 const std::string& where, Diagnostics& problems, Eigen::VectorXd& q) {
  q = Eigen::VectorXd::Zero(hand.num_joints());
  YamlMap map(node, file, where, problems);
  for (const Digit& digit : hand.digits) {
    std::vector<double> angles_deg;
    map.Read(digit.id, angles_deg);
    const std::vector<int> actuated = FindDrivenJoints(hand, digit);
    if (!map.Has(digit.id)) continue;
    if (angles_deg.size() != actuated.size()) {
      map.Fail(digit.id, "expected " + std::to_string(actuated.size()) +
                             " angles, one for each driven joint from base to tip, found " +
                             std::to_string(angles_deg.size()));
      continue;
    }
    for (size_t i = 0; i < actuated.size(); ++i) {
      const HandJoint& joint = hand.joints[actuated[i]];
      const double angle = FromDisplayUnits(joint, angles_deg[i]);
      constexpr double kRounding = 1e-4;  // limits are written with four digits
      if (angle < joint.lower - kRounding || angle > joint.upper + kRounding) {
        map.Fail(digit.id, "joint " + joint.name + " at " + std::to_string(angles_deg[i]) + " " +
                               DisplayUnitOf(joint) + " is outside its limits");
      }
      q[actuated[i]] = std::clamp(angle, joint.lower, joint.upper);
    }
  }
  map.FinishKnownKeys();
  ApplyCoupling(hand, q);
}

std::string FormatPosture(const Hand& hand, const Eigen::VectorXd& q, int decimals) {
  std::string text;
  for (const Digit& digit : hand.digits) {
    text += (text.empty() ? "" : ", ") + FormatYamlWord(digit.id) + ": [";
    const char* separator = "";
    for (const int joint : FindDrivenJoints(hand, digit)) {
      text += fmt::format("{}{:.{}f}", separator, ToDisplayUnits(hand.joints[joint], q[joint]),
                          decimals);
      separator = ", ";
    }
    text += "]";
  }
  return "{" + text + "}";
}

Eigen::VectorXd RoundPosture(const Hand& hand, const Eigen::VectorXd& q, int decimals) {
  const double scale = std::pow(10.0, decimals);
  Eigen::VectorXd rounded = q;
  for (int j = 0; j < hand.num_joints(); ++j) {
    const HandJoint& joint = hand.joints[j];
    const double written = std::round(ToDisplayUnits(joint, q[j]) * scale) / scale;
    rounded[j] = std::clamp(FromDisplayUnits(joint, written), joint.lower, joint.upper);
  }
  ApplyCoupling(hand, rounded);
  return rounded;
}

void CheckGraspDigits(const Hand& hand, const std::vector<std::string>& digits, YamlMap& map) {
  std::vector<std::string> known;
  for (const Digit& digit : hand.digits) known.push_back(digit.id);
  for (const std::string& id : digits) {
    if (std::find(known.begin(), known.end(), id) == known.end()) {
      map.Fail("digits", "the hand has no digit \"" + id + "\"" + SuggestNames(id, known));
    }
  }
  const std::set<std::string> distinct(digits.begin(), digits.end());
  if (distinct.size() < digits.size()) map.Fail("digits", "a digit is listed twice");
  if (digits.size() < 2) map.Fail("digits", "a grasp needs at least two digits");
}

}  // namespace graspbench
