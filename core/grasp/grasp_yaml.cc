#include "core/grasp/grasp_yaml.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/text/text.h"
#include "core/base/text/yaml.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

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

void ReadClosing(const GraspNode& part, Grasp& grasp) {
  const YAML::Node node = part.map.Child("closing", Needed::kNo);
  if (node.IsNull()) return;
  YamlMap digits(node, part.file, part.where + "closing", part.problems);
  for (const std::string& id : grasp.digits) {
    const YAML::Node child = digits.Child(id, Needed::kNo);
    if (child.IsNull()) continue;
    YamlMap of_digit(child, part.file, part.where + "closing of " + id, part.problems, &part.keys,
                     part.prefix + "closing.DIGIT.");
    ClosingSchedule schedule;
    of_digit.Read("delay_s", schedule.delay, Needed::kNo);
    of_digit.Read("speed", schedule.speed, Needed::kNo);
    of_digit.FinishKnownKeys();
    if (!(schedule == ClosingSchedule())) grasp.closing[id] = schedule;
  }
  digits.FinishKnownKeys();
}

}  // namespace

const FileKeys& ListHandGraspKeys() {
  static const FileKeys keys = {
      {"grasps.ID.digits", kRequired, "ids of the digits that grasp; at least two"},
      {"grasps.ID.tilt_deg", kRequired, "turn of the hand towards its fingertips, from above"},
      {"grasps.ID.palm_may_touch", "false", KeyType::kBoolean,
       "true of power and encompassing precision"},
      {"grasps.ID.palm_gap_m", "0.003",
       "where the palm may touch: how far it stops before the object; it may draw it in", 0, 0.05},
      {"grasps.ID.seeks_palm", "false", KeyType::kBoolean,
       "the hand comes on until its palm touches, before it closes; needs palm_may_touch"},
      {"grasps.ID.held_share", "",
       "of shapes not met in development, how many it held; of grasps that can take an object, "
       "those that held half are preferred",
       0, 1},
      {"grasps.ID.as_called_share", "",
       "of those that it held, the share with the opposition of its name", 0, 1},
      {"grasps.ID.approach", "automatic", "approach direction: automatic, above or side"},
      {"grasps.ID.changed", "", "where the postures come from, for people"},
      {"grasps.ID.closing", "",
       "when and how fast digits close, by digit; those left out as all do"},
      {"grasps.ID.closing.DIGIT.delay_s", "0", "after the start of closure", 0, 10},
      {"grasps.ID.closing.DIGIT.speed", "1", "share of the speed of all", 0.05, 10},
      {"grasps.ID.pre_deg", kRequired,
       "open posture: by digit, a value for each joint with a drive; of joints that slide in mm"},
      {"grasps.ID.target_deg", kRequired, "closed posture, with nothing between the fingers"},
  };
  return keys;
}

const FileKeys& ListGraspFileKeys() {
  static const FileKeys keys = [] {
    FileKeys rows = {
        {"format", kRequired, "graspbench grasp"},
        {"format_version", kRequired, "1"},
        {"made_from", kRequired, "the standard grasp whose type and approach it has: g1 to g6"},
        {"id", kRequired, "its name; not that of a standard grasp"},
        {"object", "", "the one object it is for; else any"},
    };
    for (FileKey row : ListHandGraspKeys()) {
      row.key.erase(0, std::string("grasps.ID.").size());
      if (row.key != "held_share" && row.key != "as_called_share" && row.key != "changed") {
        rows.push_back(row);
      }
    }
    const FileKeys rest = {
        {"hand", kRequired, "id of the hand it is for"},
        {"placement", "", "where the hand stands; else computed from the object's size"},
        {"placement.position_m", kRequired,
         "of the hand's base, the object at rest above the origin"},
        {"placement.orientation_wxyz", kRequired, "of the hand's base, a unit quaternion"},
        {"placement.approach", kRequired, "the way to the object, a unit vector"},
        {"placement.closing_at_contact", kRequired, "share of the closure at the first contact", 0,
         1},
        {"course", "", "a recorded reach that placing and closing follow; else the strategy's own"},
        {"course.period_s", kRequired, "between its instants", 0.001, 1},
        {"course.closure_start_s", kRequired, "start of closure after its first instant", 0, 60},
        {"course.x_m", kRequired,
         "displacement of the hand from its grasp position at each instant, in its own axes", -2,
         2},
        {"course.y_m", kRequired, "as x_m", -2, 2},
        {"course.z_m", kRequired, "as x_m", -2, 2},
        {"course.closing", kRequired,
         "by digit: share of the way from pre-grasp to target posture at each instant"},
    };
    rows.insert(rows.end(), rest.begin(), rest.end());
    return rows;
  }();
  return keys;
}

Grasp ReadGrasp(const Hand* hand, const GraspTaxon& taxon, const GraspNode& node) {
  YamlMap& map = node.map;
  Grasp grasp;
  grasp.id = taxon.id;
  grasp.type = taxon.type;
  grasp.approach_distance = taxon.approach_distance;
  grasp.alpha = taxon.alpha;
  double tilt_deg = 0.0;
  map.Read("digits", grasp.digits);
  map.Read("tilt_deg", tilt_deg);
  map.Read("palm_may_touch", grasp.palm_may_touch, Needed::kNo);
  map.Read("palm_gap_m", grasp.palm_gap, Needed::kNo);
  map.Read("seeks_palm", grasp.seeks_palm, Needed::kNo);
  if (grasp.seeks_palm && !grasp.palm_may_touch) {
    map.Fail("seeks_palm", "true, but palm_may_touch is false; set that to true, too");
  }
  ReadApproach(map, grasp.approach);
  grasp.tilt = RadFromDeg(tilt_deg);
  const YAML::Node pre = map.Child("pre_deg"), target = map.Child("target_deg");
  if (hand) CheckGraspDigits(*hand, grasp.digits, map);
  ReadClosing(node, grasp);
  if (!hand) return grasp;
  ReadPosture(*hand, pre, node.file, node.where + "pre_deg", node.problems, grasp.q_pre);
  ReadPosture(*hand, target, node.file, node.where + "target_deg", node.problems, grasp.q_target);
  return grasp;
}

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

std::string FormatClosing(const Grasp& grasp) {
  std::string text;
  for (const auto& [digit, schedule] : grasp.closing) {
    text += fmt::format("{}{}: {{delay_s: {:.6f}, speed: {:.6f}}}", text.empty() ? "" : ", ", digit,
                        schedule.delay, schedule.speed);
  }
  return "{" + text + "}";
}

}  // namespace graspbench
