#include "workbench/shell/shell_cards.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/arm/mounted_arm.h"
#include "core/base/config.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/develop/hand_pads.h"
#include "core/quality/grasp_quality.h"
#include "core/quality/holding_force.h"
#include "core/trial/measures/stability.h"
#include "workbench/tables/text_table.h"
#include "workbench/text/trial_text.h"

namespace graspbench {

namespace {

const Eigen::VectorXd& FindPosture(ShellScene& scene, const std::string& posture) {
  const Grasp& grasp = scene.setup().grasp;
  if (posture == "pre") return grasp.q_pre;
  if (posture == "target") return grasp.q_target;
  return scene.course().world().state().q;
}

std::string FormatVector(const Eigen::Vector3d& v, int decimals) {
  return FormatFixed(v.x(), decimals) + ", " + FormatFixed(v.y(), decimals) + ", " +
         FormatFixed(v.z(), decimals);
}

}  // namespace

std::string FormatWrenchSpace(ShellScene& scene) {
  const TrialSetup& setup = scene.setup();
  const GraspInstant instant = StabilityMeter(setup).MakeInstant(scene.course().world());
  QualityRequest request;
  request.contacts = instant.grasp.contacts;
  request.torque_scale =
      request.convention.calc_torque_scale({instant.grasp.radius, setup.object->size});
  const std::vector<std::string> problems = ListProblems(request);
  if (!problems.empty()) return "no wrench space: " + problems.front() + "\n";
  const GraspQuality quality = CalcGraspQuality(request);
  TextTable table({"in the object's frame", "1 N shared by all", "1 N at each contact"});
  for (const TaskForce& task : quality.task_forces) {
    table.AddRow({task.direction, FormatSignificant(task.sum_limited, 3),
                  FormatSignificant(task.each_limited, 3)});
  }
  return fmt::format("epsilon  {}, volume {}, {}force closure, smallest singular value {}\n",
                     FormatFixed(quality.epsilon, 4), FormatSignificant(quality.volume, 3),
                     quality.force_closure ? "" : "no ",
                     FormatSignificant(quality.min_singular_value, 3)) +
         table.Format() + "forces in N, moments in N m; " + quality.description + "\n";
}

std::string FormatPads(ShellScene& scene, const std::string& posture) {
  const Hand& hand = *scene.setup().hand;
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, FindPosture(scene, posture));
  std::vector<PadState> pads;
  const PadState* opposing = nullptr;
  pads.reserve(hand.digits.size());
  for (const Digit& digit : hand.digits) {
    pads.push_back(CalcPadState(hand, digit, X_HL));
    if (digit.is_thumb) opposing = &pads.back();
  }
  TextTable table({"digit", "pad at x, y, z [mm]", "faces", "to the thumb pad [mm]",
                   "angle to the thumb pad [deg]"});
  for (size_t d = 0; d < pads.size(); ++d) {
    const bool is_other = opposing && opposing != &pads[d];
    const double opening = is_other ? (pads[d].p_HPad - opposing->p_HPad).norm() : kUnset;
    const double turn =
        is_other ? std::acos(std::clamp(pads[d].nhat_H.dot(opposing->nhat_H), -1.0, 1.0)) : kUnset;
    table.AddRow({hand.digits[d].id, FormatVector(MmFromM(1.0) * pads[d].p_HPad, 1),
                  FormatVector(pads[d].nhat_H, 2), FormatFixed(MmFromM(opening), 1),
                  FormatFixed(DegFromRad(turn), 0)});
  }
  return table.Format() + "in the hand frame; 180 deg: pad against pad\n";
}

namespace {

constexpr int kBarWidth = 20;
constexpr double kWholeCone = 0.99;     // share of a cone below which its limit is explained
constexpr double kAtLimit = 1e-3;       // from it [rad]
constexpr double kAtSlideLimit = 1e-5;  // [m]

std::vector<HandContact> FindContacts(ShellScene& scene) {
  std::vector<HandContact> contacts;
  scene.course().world().FindHandContacts(contacts);
  return contacts;
}

std::string NameDigit(const Hand& hand, int link) {
  const int digit = hand.FindDigitOfLink(link);
  return digit < 0 ? "palm" : hand.digits[static_cast<size_t>(digit)].id;
}

/** Share of the largest spin moment, mu N r, in use; NaN: a point, which resists no spin. */
double CalcTorsionShare(const HandContact& contact) {
  const double most = contact.mu * contact.normal_force * contact.torsion_radius;
  return most > 0.0 ? std::abs(contact.spin_moment) / most : kUnset;
}

/** "[....#....]": where a value is between its limits. */
std::string DrawBar(double value, double low, double high) {
  const double share = high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.0;
  std::string bar(kBarWidth, '.');
  bar[static_cast<size_t>(std::lround(share * (kBarWidth - 1)))] = '#';
  return "[" + bar + "]";
}

}  // namespace

std::string FormatStatus(ShellScene& scene) {
  const TrialNotes& notes = scene.notes();
  std::string text = fmt::format(
      "{} s  {}  grip {} N  table {} N  {}\n", FormatFixed(notes.time, 3), NameOf(notes.phase),
      FormatFixed(notes.report.grip_force, 2), FormatFixed(notes.report.table_force, 2),
      FormatCount(static_cast<int64_t>(FindContacts(scene).size()), "contact"));
  if (!scene.is_over()) return text;
  return text + FormatOutcome(scene.course().End());
}

std::string FormatScene(ShellScene& scene) {
  const TrialSetup& setup = scene.setup();
  const SceneChoice& choice = scene.choice();
  const std::string draw = choice.draw ? std::to_string(*choice.draw) : "none";
  std::string text = "hand     " + setup.hand->name + " (" + setup.hand->id + ")\n";
  if (setup.arm) text += "arm      " + DescribeArmPlace(*setup.arm) + "\n";
  text += "object   " + setup.object->name + " (" + setup.object->id + "), " +
          FormatFixed(GFromKg(setup.object->mass_properties.mass), 0) + " g\n";
  text += "grasp    " + setup.grasp.id;
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    if (taxon.id == setup.grasp.id) text += ", " + taxon.name;
  }
  if (!choice.joints.empty()) {
    text +=
        ", " + FormatCount(static_cast<int64_t>(choice.joints.size()), "joint") + " set by hand";
  }
  if (!choice.drives.empty()) {
    text += ", " + FormatCount(static_cast<int64_t>(choice.drives.size()), "drive") + " by hand";
  }
  if (!choice.closing.empty()) text += ", closing schedule by hand";
  text += choice.hand_place ? ", hand moved\n" : "\n";
  text += "draw     " + draw + (choice.place ? ", moved by hand" : "") + ": " +
          FormatObjectDraw(setup.draw) + "\n";
  return text + FormatStatus(scene);
}

std::string FormatJoints(ShellScene& scene) {
  const Hand& hand = *scene.setup().hand;
  const Eigen::VectorXd& q = scene.course().world().state().q;
  const Eigen::VectorXd& asked = scene.notes().command.q;
  TextTable table({"joint", "angle [deg]", "from", "to", "", "asked [deg]", ""});
  for (size_t j = 0; j < hand.joints.size(); ++j) {
    const HandJoint& joint = hand.joints[j];
    const auto format = [&joint](double position, int decimals) {
      return FormatFixed(ToDisplayUnits(joint, position), decimals) +
             (joint.is_prismatic ? " mm" : "");
    };
    const double angle = q[static_cast<Eigen::Index>(j)];
    const double margin = joint.is_prismatic ? kAtSlideLimit : kAtLimit;
    const bool is_at_limit = angle < joint.lower + margin || angle > joint.upper - margin;
    std::string command = "n/a";
    if (joint.coupled_to >= 0) {
      command = "with " + hand.joints[static_cast<size_t>(joint.coupled_to)].name;
    } else if (asked.size() > 0) {
      command = format(asked[static_cast<Eigen::Index>(j)], 1);
    }
    table.AddRow({joint.name, format(angle, 1), format(joint.lower, 0), format(joint.upper, 0),
                  DrawBar(angle, joint.lower, joint.upper), command,
                  is_at_limit ? "at its limit" : ""});
  }
  return table.Format();
}

std::string FormatContacts(ShellScene& scene) {
  const Hand& hand = *scene.setup().hand;
  const std::vector<HandContact> contacts = FindContacts(scene);
  if (contacts.empty()) return "the hand does not touch the object\n";
  TextTable table(
      {"digit", "link", "normal [N]", "friction [N]", "of its cone", "state", "slip [mm/s]"});
  std::string below;
  for (const HandContact& contact : contacts) {
    const std::string& link = hand.links[static_cast<size_t>(contact.link)].name;
    const double share = CalcConeShare(contact), torsion = CalcTorsionShare(contact);
    table.AddRow({NameDigit(hand, contact.link), link, FormatFixed(contact.normal_force, 3),
                  FormatFixed(contact.friction_W.norm(), 3), FormatPercent(share),
                  DescribeState(contact), FormatFixed(MmFromM(contact.slip_speed), 2)});
    if (!contact.is_at_limit || share > kWholeCone || std::isnan(torsion)) continue;
    below += (below.empty() ? "" : ", ") + link + " " + FormatPercent(torsion);
  }
  if (below.empty()) return table.Format();
  return table.Format() + "slips below the friction cone: torsion uses " + below +
         " of the pad's torsion limit;\na pad slips when the squares of both shares sum to 1\n";
}

std::string FormatTiming(ShellScene& scene) {
  const TrialNotes& notes = scene.notes();
  if (std::isnan(notes.closure_start)) return "closure has not begun\n";
  std::vector<DigitContact> contacts = notes.result.contacts;
  for (DigitContact& contact : contacts) contact.time -= notes.closure_start;
  TextTable table({"digit", "first touch [ms]"});
  for (const DigitContact& contact : contacts) {
    table.AddRow({contact.digit.str() + (contact.is_opposing ? " (opposes)" : ""),
                  FormatFixed(MsFromS(contact.time), 1)});
  }
  const ContactTiming timing = CalcContactTiming(contacts, 0.0);
  return table.Format() +
         fmt::format("GCT {} ms, GFT {} ms ({}), GOT {} ms ({}); since the start of closure\n",
                     FormatFixed(MsFromS(timing.gct), 1), FormatFixed(MsFromS(timing.gft), 1),
                     FormatPercent(timing.gft_ratio), FormatFixed(MsFromS(timing.got), 1),
                     FormatPercent(timing.got_ratio)) +
         (timing.contact_before_start ? kNotComparable + std::string("\n") : "");
}

std::string FormatStability(ShellScene& scene) {
  const GraspInstant instant = StabilityMeter(scene.setup()).MakeInstant(scene.course().world());
  if (instant.grasp.contacts.empty()) return "the hand does not touch the object\n";
  const StabilityPart now = CalcStabilityPart({instant});
  std::string text = fmt::format(
      "now      sigma {} N, epsilon {}, normal force {} N, slip {} mm/s, {}\n",
      FormatFixed(now.sigma, 2), FormatFixed(now.quality, 4), FormatFixed(now.normal_force, 2),
      FormatFixed(MmFromM(now.slip_speed), 2), instant.is_opposed ? "opposed" : "not opposed");
  std::vector<Eigen::Vector3d> directions;
  for (int axis = 0; axis < 3; ++axis) {
    directions.emplace_back(instant.R_OPalm.col(axis));
    directions.emplace_back(-instant.R_OPalm.col(axis));
  }
  const std::vector<double> pulls = CalcHoldingForces(instant.grasp, directions);
  TextTable table({"pull in the palm frame", "+ [N]", "- [N]"});
  for (size_t axis = 0; axis < 3; ++axis) {
    table.AddRow({std::string(1, static_cast<char>('x' + axis)), FormatFixed(pulls[2 * axis], 2),
                  FormatFixed(pulls[2 * axis + 1], 2)});
  }
  text += table.Format();
  if (!scene.is_over()) return text;
  const Stability trial = scene.course().End().stability;
  return text + fmt::format("trial    sigma {} N over the hold, grip {} N before lift-off\n",
                            FormatFixed(trial.sigma, 2),
                            FormatFixed(scene.notes().result.grip_force, 2));
}

std::string FormatSettings(const SessionConfig& config, const std::string& part) {
  std::string text;
  const Json settings = ConfigToJson(config);
  for (const auto& [block, values] : settings.items()) {
    if (!values.is_object() && block != "seed" && block != "approach" && block != "positioning" &&
        block != "touch") {
      continue;
    }
    const Json named = values.is_object() ? values : Json{{"", values}};
    for (const auto& [key, value] : named.items()) {
      const std::string name = key.empty() ? block : block + "." + key;
      if (name.find(part) != name.npos) text += name + " " + value.dump() + "\n";
    }
  }
  return text;
}

std::vector<std::string> ListSettingKeys(const SessionConfig& config) {
  std::vector<std::string> keys;
  std::istringstream settings(FormatSettings(config, ""));
  for (std::string line; std::getline(settings, line);) {
    keys.push_back(line.substr(0, line.find(' ')));
  }
  return keys;
}

std::string FormatChanges(const ShellScene& scene) {
  const SceneChoice& choice = scene.choice();
  const Hand& hand = *scene.setup().hand;
  std::string text;
  if (choice.place) {
    text += fmt::format(
        "place    x {} mm, y {} mm, yaw {} deg\n", FormatFixed(MmFromM(choice.place->x), 1),
        FormatFixed(MmFromM(choice.place->y), 1), FormatFixed(DegFromRad(choice.place->yaw), 1));
  }
  if (choice.learned) text += "grasp    " + choice.learned->id + ", learned here\n";
  if (choice.hand_place) {
    const auto list = [](const Eigen::Vector3d& v, double unit) {
      return fmt::format("{} {} {}", FormatFixed(unit * v.x(), 1), FormatFixed(unit * v.y(), 1),
                         FormatFixed(unit * v.z(), 1));
    };
    text += "hand     moved " + list(choice.hand_place->shift, MmFromM(1.0)) + " mm, turned " +
            list(choice.hand_place->angles, DegFromRad(1.0)) + " deg about x y z\n";
  }
  const Grasp grasp = scene.unedited_grasp();
  for (const JointEdit& edit : choice.joints) {
    const int index = hand.FindJoint(edit.joint);
    const HandJoint& joint = hand.joints[static_cast<size_t>(index)];
    const Eigen::VectorXd& q = edit.is_target ? grasp.q_target : grasp.q_pre;
    text += fmt::format("joint    {} {} {} {}, the grasp's {} {}\n", edit.joint,
                        FormatFixed(ToDisplayUnits(joint, edit.position), 1), DisplayUnitOf(joint),
                        edit.is_target ? "target" : "pre",
                        FormatFixed(ToDisplayUnits(joint, q[index]), 1), DisplayUnitOf(joint));
  }
  for (const auto& [digit, schedule] : choice.closing) {
    const auto own = grasp.closing.find(digit);
    const ClosingSchedule of_grasp = own == grasp.closing.end() ? ClosingSchedule() : own->second;
    text += fmt::format("digit    {} delay {} s, speed {}, the grasp's {} s, {}\n", digit,
                        FormatFixed(schedule.delay, 3), FormatFixed(schedule.speed, 2),
                        FormatFixed(of_grasp.delay, 3), FormatFixed(of_grasp.speed, 2));
  }
  for (const DriveEdit& edit : choice.drives) {
    const HandJoint& joint = hand.joints[static_cast<size_t>(hand.FindJoint(edit.joint))];
    text += fmt::format("drive    {} {} {} from {} s on\n", edit.joint,
                        FormatFixed(ToDisplayUnits(joint, edit.position), 1), DisplayUnitOf(joint),
                        FormatFixed(edit.time, 3));
  }
  std::istringstream now(FormatSettings(choice.config, "")), before(FormatSettings({}, ""));
  for (std::string line, other; std::getline(now, line) && std::getline(before, other);) {
    if (line == other) continue;
    text += "set      " + line + ", default" + other.substr(other.find(' ')) + "\n";
  }
  return text;
}

}  // namespace graspbench
