#include "core/trial/policy/policy_terms.h"

#include <algorithm>
#include <cmath>

#include "core/base/config.h"
#include "core/hand/hand.h"
#include "core/hand/tactile.h"
#include "core/render/scene.h"
#include "core/trial/grip/unfelt_force.h"
#include "core/trial/touch_sensors.h"
#include "core/trial/trial_setup.h"

namespace graspbench {
namespace {

using Values = std::vector<double>;

bool IsAlwaysGiven(const PolicyView&) { return true; }
bool HasSensors(const PolicyView& view) { return view.sensors != nullptr; }
bool HasPicture(const PolicyView& view) { return static_cast<bool>(view.take_picture); }
bool IsPoseGiven(const PolicyView& view) {
  return view.setup.policy.object_pose != RowOf(kPolicyObjectPoses, PolicyObjectPose::kNone).name;
}

template <class Vector>
void AppendVector(const Vector& vector, Values& values) {
  for (Eigen::Index i = 0; i < vector.size(); ++i) values.push_back(vector[i]);
}

void AppendRotation(const Eigen::Matrix3d& R, Values& values) {
  const Eigen::Quaterniond q(R);
  values.insert(values.end(), {q.w(), q.x(), q.y(), q.z()});
}

Pose FindGivenPose(const PolicyView& view) {
  const bool is_true =
      view.setup.policy.object_pose == RowOf(kPolicyObjectPoses, PolicyObjectPose::kTrue).name;
  return is_true ? view.world.CalcObjectPose() : view.told_X_WO;
}

/** Forces on the object by each digit, followed by the rest of the hand. */
Values CalcPressing(const PolicyView& view) {
  const Hand& hand = *view.setup.hand;
  Values forces(hand.digits.size() + 1, 0.0);
  if (view.sensors) {
    for (size_t d = 0; d < hand.digits.size(); ++d) {
      forces[d] = view.sensors->CalcFeltForce(static_cast<int>(d));
    }
    forces.back() = view.sensors->CalcFeltForce(-1);
    return forces;
  }
  for (const HandContact& contact : view.contacts) {
    const int digit = hand.FindDigitOfLink(contact.link);
    forces[digit >= 0 ? static_cast<size_t>(digit) : hand.digits.size()] += contact.normal_force;
  }
  return forces;
}

void FindDigitForces(const PolicyView& view, Values& values) {
  const Values forces = CalcPressing(view);
  values.insert(values.end(), forces.begin(), forces.end() - 1);
}

void FindDigitTouches(const PolicyView& view, Values& values) {
  const Hand& hand = *view.setup.hand;
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    if (view.sensors) {
      values.push_back(view.sensors->has_felt(static_cast<int>(d)) ? 1.0 : 0.0);
      continue;
    }
    const std::vector<int>& links = hand.digits[d].links;
    const bool touches = std::any_of(links.begin(), links.end(), [&](int link) {
      const auto& all = view.report.link_touches_object;
      return static_cast<size_t>(link) < all.size() && all[static_cast<size_t>(link)];
    });
    values.push_back(touches ? 1.0 : 0.0);
  }
}

void FindDriveTorques(const PolicyView& view, Values& values) {
  for (size_t i = 0; i < view.driven.size(); ++i) {
    const double share =
        view.stiffness.size() > 0 ? view.stiffness[static_cast<Eigen::Index>(i)] : 1.0;
    values.push_back(CalcDriveTorque(*view.setup.hand, view.world.dynamics(), view.world.state(),
                                     view.driven[i], view.targets[static_cast<Eigen::Index>(i)],
                                     share));
  }
}

void FindJointSpeeds(const PolicyView& view, Values& values) {
  for (int joint = 0; joint < view.setup.hand->num_joints(); ++joint) {
    values.push_back(view.world.dynamics().CalcJointSpeed(joint, view.world.state().u));
  }
}

void FindPicture(const PolicyView& view, Values& values) {
  const Image image = view.take_picture();
  values.insert(values.end(), image.rgb.begin(), image.rgb.end());
}

Json JsonRotation(const Eigen::Matrix3d& R) {
  Values values;
  AppendRotation(R, values);
  return values;
}

template <class Take>
Json ListOfDriven(const PolicyView& view, Take&& take) {
  Json list = Json::array();
  for (const int joint : view.driven) list.push_back(take(joint));
  return list;
}

Json ListDrivenDigits(const PolicyView& view) {
  const Hand& hand = *view.setup.hand;
  return ListOfDriven(view, [&](int joint) {
    const int digit = hand.FindDigitOfLink(hand.joints[static_cast<size_t>(joint)].link);
    return digit < 0 ? std::string() : hand.digits[static_cast<size_t>(digit)].id;
  });
}

template <class Take>
Json ListOfElements(const PolicyView& view, Take&& take) {
  if (!view.sensors) return Json();
  Json list = Json::array();
  for (const TactileElement& element : view.setup.hand->skin->elements) {
    list.push_back(take(element));
  }
  return list;
}

/** Delay and speed of each digit's closing. */
Json ListClosing(const PolicyView& view) {
  Json schedules = Json::object();
  for (const std::string& digit : view.setup.grasp.digits) {
    const auto found = view.setup.grasp.closing.find(digit);
    const ClosingSchedule schedule =
        found == view.setup.grasp.closing.end() ? ClosingSchedule() : found->second;
    schedules[digit] = {schedule.delay, schedule.speed};
  }
  return schedules;
}

}  // namespace

const std::vector<PolicyObservation>& ListPolicyObservations() {
  static const std::vector<PolicyObservation> observations = {
      {{"time", "s", "", "", "time since control began"},
       IsAlwaysGiven,
       [](const PolicyView& view, Values& values) { values.push_back(view.time); },
       true},
      {{"phase", "", "", "",
        "0: closure, until all grasping digits have touched or the waiting time is over; 1: "
        "stabilisation"},
       IsAlwaysGiven,
       [](const PolicyView& view, Values& values) {
         values.push_back(view.phase == Phase::kClosure ? 0.0 : 1.0);
       },
       true},
      {{"time_in_phase", "s", "", "", "time since the phase began"},
       IsAlwaysGiven,
       [](const PolicyView& view, Values& values) { values.push_back(view.time_in_phase); },
       true},
      {{"joint_positions", "rad, m", "m", "", "positions of all joints"},
       IsAlwaysGiven,
       [](const PolicyView& view, Values& values) { AppendVector(view.world.state().q, values); },
       false,
       &PolicyConfig::joint_noise},
      {{"joint_speeds", "rad/s, m/s", "m", "", "speeds of all joints"},
       IsAlwaysGiven,
       FindJointSpeeds,
       false},
      {{"targets", "rad, m", "n", "", "last targets of the driven joints"},
       IsAlwaysGiven,
       [](const PolicyView& view, Values& values) { AppendVector(view.targets, values); },
       false},
      {{"drive_torques", "N m, N", "n", "",
        "stiffness times the error of the joint, less damping, within the drive's limit"},
       IsAlwaysGiven,
       FindDriveTorques,
       false},
      {{"digit_forces", "N", "d", "",
        "sum of the normal forces of a digit on the object; with touch: sensed, measured by its "
        "elements"},
       IsAlwaysGiven,
       FindDigitForces,
       false,
       &PolicyConfig::force_noise},
      {{"palm_force", "N", "", "",
        "sum of the normal forces of the rest of the hand on the object"},
       IsAlwaysGiven,
       [](const PolicyView& view, Values& values) { values.push_back(CalcPressing(view).back()); },
       true,
       &PolicyConfig::force_noise},
      {{"grip_force", "N", "", "", "sum of the normal forces of the whole hand on the object"},
       IsAlwaysGiven,
       [](const PolicyView& view, Values& values) {
         values.push_back(view.sensors ? view.sensors->CalcFeltForce() : view.report.grip_force);
       },
       true,
       &PolicyConfig::force_noise},
      {{"digit_touches", "", "d", "",
        "1: a link of the digit touches the object; with touch: sensed, a touch has been detected "
        "at any time"},
       IsAlwaysGiven,
       FindDigitTouches,
       false},
      {{"taxels", "N", "k", "", "force on the cell of each tactile element; with touch: sensed"},
       HasSensors,
       [](const PolicyView& view, Values& values) {
         const Values& forces = view.sensors->forces();
         values.insert(values.end(), forces.begin(), forces.end());
       },
       false},
      {{"hand_position", "m", "3", "W", "position of the hand's base"},
       IsAlwaysGiven,
       [](const PolicyView& view, Values& values) {
         AppendVector(view.world.state().X_WH.translation(), values);
       },
       false},
      {{"hand_rotation", "", "4", "W", "rotation of the hand's base, a quaternion"},
       IsAlwaysGiven,
       [](const PolicyView& view, Values& values) {
         AppendRotation(view.world.state().X_WH.linear(), values);
       },
       false},
      {{"hand_velocity", "m/s, rad/s", "6", "W",
        "velocity of the hand's base: linear, then angular"},
       IsAlwaysGiven,
       [](const PolicyView& view, Values& values) {
         AppendVector(view.world.state().v_WH, values);
         AppendVector(view.world.state().w_WH, values);
       },
       false},
      {{"object_position", "m", "3", "W", "position of the object's frame; by policy.object_pose"},
       IsPoseGiven,
       [](const PolicyView& view, Values& values) {
         AppendVector(FindGivenPose(view).translation(), values);
       },
       false},
      {{"object_rotation", "", "4", "W",
        "rotation of the object's frame, a quaternion; by policy.object_pose"},
       IsPoseGiven,
       [](const PolicyView& view, Values& values) {
         AppendRotation(FindGivenPose(view).linear(), values);
       },
       false},
      {{"picture", "", "s x s x 3", "",
        "picture of the hand's camera, 8-bit RGB, rows from the top; with policy.picture_px"},
       HasPicture,
       FindPicture,
       false,
       nullptr,
       true}};
  return observations;
}

const std::vector<PolicyTerm>& ListPolicyActions() {
  static const std::vector<PolicyTerm> actions = {
      {"targets", "rad, m", "n or rows x n", "",
       "positions of the drives, a row per control period"},
      {"increments", "rad, m", "n or rows x n", "",
       "instead of targets: increment of each row on the previous targets; zeros keep the digits "
       "still"},
      {"stiffness", "", "n or rows x n", "",
       "share of the drives' own stiffness, 0 to 1; valid until the next value"},
      {"hand_pose", "m, -", "7 or rows x 7", "W",
       "pose of the hand's base at the end of the period: position, quaternion; with "
       "policy.moves: hand-and-digits"},
      {"hand_twist", "m/s, rad/s", "6 or rows x 6", "W",
       "instead of hand_pose: velocity of the hand's base for a period: linear, then angular"},
      {"hold", "", "", "",
       "force or margin: after the first row the regulator controls the grip, then the hand is "
       "lifted; with policy.moves: digits-until-touch"},
      {"done", "", "", "",
       "true: the hand is lifted after the first row, or at once for an action without rows"},
      {"error", "", "", "", "reason as text, instead of all others: the controller gives up"}};
  return actions;
}

const std::vector<PolicyFact>& ListPolicyFacts() {
  static const std::vector<PolicyFact> facts = {
      {{"trial_id", "", "", "", "id of the trial"},
       [](const PolicyView& view) { return Json(view.setup.trial_id); }},
      {{"seed", "", "", "", "whole number below 2^32, the same for every controller on a draw"},
       [](const PolicyView& view) { return Json(view.setup.policy_seed); }},
      {{"hand", "", "", "", "id of the hand"},
       [](const PolicyView& view) { return Json(view.setup.hand->id); }},
      {{"object", "", "", "", "id of the object"},
       [](const PolicyView& view) { return Json(view.setup.object->id); }},
      {{"grasp", "", "", "", "id of the standard or optimised grasp, which places the hand"},
       [](const PolicyView& view) { return Json(view.setup.grasp.id); }},
      {{"grasp_type", "", "", "",
        "all finger precision, two finger precision, power or two finger pinch"},
       [](const PolicyView& view) { return Json(NameOf(view.setup.grasp.type)); }},
      {{"joints", "", "m", "", "names of all joints"},
       [](const PolicyView& view) {
         Json names = Json::array();
         for (const HandJoint& joint : view.setup.hand->joints) names.push_back(joint.name);
         return names;
       }},
      {{"driven", "", "n", "", "names of the driven joints"},
       [](const PolicyView& view) {
         return ListOfDriven(view, [&](int joint) {
           return view.setup.hand->joints[static_cast<size_t>(joint)].name;
         });
       }},
      {{"driven_digits", "", "n", "", "id of the digit of each; empty: of the wrist"},
       ListDrivenDigits},
      {{"lower", "rad, m", "n", "", "lower limits of the driven joints"},
       [](const PolicyView& view) {
         return ListOfDriven(view, [&](int joint) {
           return view.setup.hand->joints[static_cast<size_t>(joint)].lower;
         });
       }},
      {{"upper", "rad, m", "n", "", "upper limits of the driven joints"},
       [](const PolicyView& view) {
         return ListOfDriven(view, [&](int joint) {
           return view.setup.hand->joints[static_cast<size_t>(joint)].upper;
         });
       }},
      {{"open", "rad, m", "n", "", "pre-grasp posture of the grasp, in which control begins"},
       [](const PolicyView& view) {
         return ListOfDriven(view, [&](int joint) { return view.setup.grasp.q_pre[joint]; });
       }},
      {{"closed", "rad, m", "n", "", "target posture of the grasp"},
       [](const PolicyView& view) {
         return ListOfDriven(view, [&](int joint) { return view.setup.grasp.q_target[joint]; });
       }},
      {{"digits", "", "d", "", "ids of the hand's digits"},
       [](const PolicyView& view) {
         Json ids = Json::array();
         for (const Digit& digit : view.setup.hand->digits) ids.push_back(digit.id);
         return ids;
       }},
      {{"grasping", "s, -", "", "",
        "ids of the digits that grasp, each with delay and relative speed of its closing"},
       ListClosing},
      {{"moves", "", "", "", "policy.moves"},
       [](const PolicyView& view) { return Json(view.setup.policy.moves); }},
      {{"hand_limits", "m/s, rad/s", "2", "",
        "largest speed and turn rate of the hand; with policy.moves: hand-and-digits"},
       [](const PolicyView& view) {
         const PolicyConfig& policy = view.setup.policy;
         const bool moves = policy.moves == RowOf(kPolicyMoves, PolicyMoves::kHandAndDigits).name;
         return moves ? Json(Values{policy.hand_speed, policy.hand_turn_rate}) : Json();
       }},
      {{"grasp_position", "m", "3", "W",
        "position of the hand's base in the grasp, for the pose of positioning; with "
        "policy.object_pose other than none"},
       [](const PolicyView& view) {
         return IsPoseGiven(view) ? JsonVector(view.placed_X_WH.translation()) : Json();
       }},
      {{"grasp_rotation", "", "4", "W", "rotation of the hand's base there, a quaternion"},
       [](const PolicyView& view) {
         return IsPoseGiven(view) ? JsonRotation(view.placed_X_WH.linear()) : Json();
       }},
      {{"period", "s", "", "", "control period"},
       [](const PolicyView& view) {
         const double step = view.setup.sim.step;
         return Json(step * std::max(1.0, std::round(view.setup.policy.period / step)));
       }},
      {{"execute_steps", "", "", "", "rows of an action that are used"},
       [](const PolicyView& view) { return Json(view.setup.policy.execute_steps); }},
      {{"time", "s", "", "", "longest time of control"},
       [](const PolicyView& view) { return Json(view.setup.policy.time); }},
      {{"strategy", "", "", "", "the session's keys of strategy, by name"},
       [](const PolicyView& view) { return ConfigToJson(view.setup.strategy); }},
      {{"weight", "N", "", "", "weight of the object"},
       [](const PolicyView& view) {
         return Json(view.setup.object->mass_properties.mass * view.setup.sim.gravity);
       }},
      {{"friction", "", "", "",
        "dynamic friction coefficient of the object, as known to the regulator"},
       [](const PolicyView& view) { return Json(view.setup.object->surface.friction_dynamic); }},
      {{"taxel_links", "", "k", "", "link of each tactile element; with touch: sensed"},
       [](const PolicyView& view) {
         return ListOfElements(view, [&](const TactileElement& element) {
           return view.setup.hand->links[static_cast<size_t>(element.link)].name;
         });
       }},
      {{"taxel_positions", "m", "k x 3", "L",
        "position of each tactile element; with touch: sensed"},
       [](const PolicyView& view) {
         return ListOfElements(view, [](const TactileElement& e) { return JsonVector(e.p_LE); });
       }},
      {{"taxel_normals", "", "k x 3", "L",
        "unit normal of each tactile element, out of the hand; with touch: sensed"},
       [](const PolicyView& view) {
         return ListOfElements(view,
                               [](const TactileElement& e) { return JsonVector(e.normal_L); });
       }}};
  return facts;
}

namespace {

std::string FormatRow(const PolicyTerm& term) {
  return std::string("| `") + term.name + "` | " + term.unit + " | " + term.shape + " | " +
         term.frame + " | " + term.meaning + " |\n";
}

constexpr char kTermHead[] =
    "| name | unit | shape | frame | meaning |\n| --- | --- | --- | --- | --- |\n";

}  // namespace

std::string FormatPolicyTerms() {
  std::string text = std::string("### Observations\n\n") + kTermHead;
  for (const PolicyObservation& row : ListPolicyObservations()) text += FormatRow(row.term);
  text += std::string("\n### Actions\n\n") + kTermHead;
  for (const PolicyTerm& term : ListPolicyActions()) text += FormatRow(term);
  text += std::string("\n### Facts of a trial\n\n") + kTermHead;
  for (const PolicyFact& row : ListPolicyFacts()) text += FormatRow(row.term);
  return text;
}

}  // namespace graspbench
