#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <vector>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/coupling.h"
#include "core/hand/load_hand.h"
#include "workbench/commands/command.h"
#include "workbench/diagnostics_output.h"
#include "workbench/text_table.h"

namespace graspbench {
namespace {

int CountFreedoms(const Hand& hand) {
  return static_cast<int>(std::count_if(hand.joints.begin(), hand.joints.end(),
                                        [](const HandJoint& j) { return j.coupled_to < 0; }));
}

std::vector<std::string> ListDigits(const Hand& hand) {
  std::vector<std::string> ids;
  for (const Digit& digit : hand.digits) ids.push_back(digit.id);
  return ids;
}

std::vector<std::string> ListGrasps(const Hand& hand) {
  std::vector<std::string> ids;
  for (const StandardGrasp& grasp : LoadStandardGrasps(hand)) ids.push_back(grasp.id);
  return ids;
}

std::string JoinWords(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

void ListHandsCommand(bool json) {
  Json list = Json::array();
  TextTable table({"id", "name", "digits", "joints", "driven", "grasps"});
  for (const std::string& id : ListHands()) {
    const Hand hand = LoadHand(id);
    list.push_back({{"id", id},
                    {"name", hand.name},
                    {"digits", ListDigits(hand)},
                    {"joints", hand.num_joints()},
                    {"driven", CountFreedoms(hand)},
                    {"grasps", ListGrasps(hand)}});
    table.AddRow({id, hand.name, JoinWords(ListDigits(hand)), std::to_string(hand.num_joints()),
                  std::to_string(CountFreedoms(hand)), JoinWords(ListGrasps(hand))});
  }
  if (json) {
    PrintJson({{"hands", list}});
  } else {
    std::cout << table.Format();
  }
}

Json MakeHandJson(const Hand& hand) {
  Json joints = Json::array();
  for (const HandJoint& joint : hand.joints) {
    Json entry = {{"name", joint.name},
                  {"lower_deg", DegFromRad(joint.lower)},
                  {"upper_deg", DegFromRad(joint.upper)}};
    if (joint.coupled_to >= 0) {
      entry["coupled_to"] = hand.joints[joint.coupled_to].name;
    } else {
      entry["stiffness_nm_per_rad"] = joint.drive.stiffness;
      entry["damping_nms_per_rad"] = joint.drive.damping;
      entry["torque_limit_nm"] = joint.drive.torque_limit;
    }
    joints.push_back(entry);
  }
  double mass = 0.0;
  for (const HandLink& link : hand.links) mass += link.mass;
  return {{"id", hand.id},
          {"name", hand.name},
          {"mass_kg", mass},
          {"digits", ListDigits(hand)},
          {"grasps", ListGrasps(hand)},
          {"coupling", NameOf(hand.coupling)},
          {"joint_accuracy_deg", DegFromRad(hand.joint_accuracy)},
          {"joints", joints}};
}

void ShowHand(const std::string& id, bool json) {
  const Hand hand = LoadHand(id);
  const Json description = MakeHandJson(hand);
  if (json) {
    PrintJson(description);
    return;
  }
  std::cout << hand.name << " (" << hand.id << ")\n\nmass            "
            << FormatSignificant(description["mass_kg"].get<double>(), 3) << " kg\ndigits          "
            << JoinWords(ListDigits(hand)) << "\ngrasps          " << JoinWords(ListGrasps(hand))
            << "\ncoupling        " << NameOf(hand.coupling) << "\njoint accuracy  +-"
            << FormatSignificant(DegFromRad(hand.joint_accuracy), 3) << " deg\n\n";
  TextTable table({"joint", "lower [deg]", "upper [deg]", "stiffness [N m/rad]",
                   "torque limit [N m]", "follows"});
  for (const HandJoint& joint : hand.joints) {
    const bool is_coupled = joint.coupled_to >= 0;
    table.AddRow({joint.name, FormatFixed(DegFromRad(joint.lower), 1),
                  FormatFixed(DegFromRad(joint.upper), 1),
                  is_coupled ? "-" : FormatSignificant(joint.drive.stiffness, 3),
                  is_coupled ? "-" : FormatSignificant(joint.drive.torque_limit, 3),
                  is_coupled ? hand.joints[joint.coupled_to].name : ""});
  }
  std::cout << table.Format();
}

ExitCode CheckHandCommand(const std::string& path, bool json) {
  Diagnostics problems;
  const Hand hand = CheckHand(path, problems);
  if (problems.num_errors() == 0) {
    try {
      LoadStandardGrasps(hand);
    } catch (const Error& error) {
      problems.Fail(path, 0, error.what());
    }
  }
  if (json) {
    PrintJson({{"usable", problems.num_errors() == 0}, {"problems", MakeJson(problems)}});
  } else {
    PrintFindings(problems);
    std::cout << path << ": " << (problems.num_errors() == 0 ? "can be used" : "cannot be used")
              << FormatFindingCounts(problems) << '\n';
  }
  return problems.num_errors() == 0 ? kExitOk : kExitBadInput;
}

/** Reads "FFJ3=30" into q. Joints are named in degrees; those outside their limits are told. */
void SetJoint(const std::string& assignment, const Hand& hand, Eigen::VectorXd& q) {
  const size_t equals = assignment.find('=');
  const std::string name = assignment.substr(0, equals);
  const int joint = hand.FindJoint(name);
  if (joint < 0) {
    std::vector<std::string> known;
    for (const HandJoint& candidate : hand.joints) known.push_back(candidate.name);
    throw Error(ErrorKind::kUsage,
                "the " + hand.name + " has no joint \"" + name + "\"" + SuggestNames(name, known));
  }
  double angle_deg = 0.0;
  if (equals == std::string::npos ||
      !CLI::detail::lexical_cast(assignment.substr(equals + 1), angle_deg) ||
      !std::isfinite(angle_deg)) {
    throw Error(
        ErrorKind::kUsage,
        "\"" + assignment + "\" is no joint angle; expected NAME=DEG, e.g. " + name + "=30");
  }
  q[joint] = RadFromDeg(angle_deg);
  const HandJoint& limits = hand.joints[joint];
  constexpr double kTolerance = 1e-9;  // [rad] limits in degrees are not exact in radians
  if (q[joint] < limits.lower - kTolerance || q[joint] > limits.upper + kTolerance) {
    std::cerr << "note: " << name << " = " << FormatSignificant(angle_deg, 4)
              << " deg is outside its limits " << FormatSignificant(DegFromRad(limits.lower), 4)
              << " .. " << FormatSignificant(DegFromRad(limits.upper), 4) << " deg\n";
  }
}

void CalcForwardKinematics(const std::string& id, const std::vector<std::string>& joints,
                           bool json) {
  const Hand hand = LoadHand(id);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(hand.num_joints());
  for (const std::string& assignment : joints) SetJoint(assignment, hand, q);
  const Eigen::VectorXd named = q;
  ApplyCoupling(hand, q);
  for (const std::string& assignment : joints) {  // a coupled joint named explicitly is kept
    const int joint = hand.FindJoint(assignment.substr(0, assignment.find('=')));
    q[joint] = named[joint];
  }

  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  const Pose X_PalmH = X_HL[hand.palm_link].inverse();
  Json frames = Json::object();
  TextTable table({"digit", "x [mm]", "y [mm]", "z [mm]"});
  for (const Digit& digit : hand.digits) {
    const Pose X_PalmL = X_PalmH * X_HL[digit.distal_link];
    const Eigen::Vector3d p = X_PalmL.translation();
    Json rows = Json::array();
    for (int row = 0; row < 3; ++row) rows.push_back(JsonVector(X_PalmL.linear().row(row)));
    frames[digit.id] = {{"p_m", JsonVector(p)}, {"R", rows}};
    table.AddRow({digit.id, FormatFixed(MmFromM(p.x()), 2), FormatFixed(MmFromM(p.y()), 2),
                  FormatFixed(MmFromM(p.z()), 2)});
  }
  if (json) {
    PrintJson(frames);
  } else {
    std::cout << "origin of each digit's last link, in the palm's frame\n" << table.Format();
  }
}

}  // namespace

void AddHandCommand(CLI::App& program, ExitCode& exit_code) {
  CLI::App& group = AddSubcommand(program, "hand", "Shows and checks hands.",
                                  "  graspbench hand list\n"
                                  "  graspbench hand check my_hand/");
  group.require_subcommand(1);
  const auto id = std::make_shared<std::string>();
  const auto joints = std::make_shared<std::vector<std::string>>();
  const auto json = std::make_shared<bool>(false);
  const auto add = [&](const char* name, const char* description, const char* examples) {
    CLI::App& command = AddSubcommand(group, name, description, examples);
    command.add_flag("--json", *json, "one JSON object");
    return &command;
  };
  const auto add_hand = [&](CLI::App* command) {
    command->add_option("hand", *id, "id, or folder with hand.urdf and hand.yaml")
        ->required()
        ->option_text("HAND");
  };

  CLI::App* list = add("list", "Lists the hands that come with the program.",
                       "  graspbench hand list\n"
                       "  graspbench hand list --json");
  list->callback([json] { ListHandsCommand(*json); });

  CLI::App* show = add("show", "Shows joints, limits, drives and grasps of a hand.",
                       "  graspbench hand show shadow\n"
                       "  graspbench hand show my_hand/ --json");
  add_hand(show);
  show->callback([id, json] { ShowHand(*id, *json); });

  CLI::App* check = add("check", "Reads a hand and lists every problem with file and line.",
                        "  graspbench hand check my_hand/\n"
                        "  graspbench hand check my_hand/ --json");
  add_hand(check);
  check->callback([id, json, &exit_code] { exit_code = CheckHandCommand(*id, *json); });

  CLI::App* fk = add("fk", "Forward kinematics: the last link of each digit in the palm's frame.",
                     "  graspbench hand fk shadow --joints FFJ3=30,FFJ2=45\n"
                     "  graspbench hand fk shadow --joints THJ5=20,THJ4=40 --json");
  add_hand(fk);
  fk->add_option("--joints", *joints,
                 "joint angles in degrees; others are zero, coupled ones follow")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("NAME=DEG,..");
  fk->callback([id, joints, json] { CalcForwardKinematics(*id, *joints, *json); });
}

}  // namespace graspbench
