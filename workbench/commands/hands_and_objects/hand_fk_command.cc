#include <cmath>
#include <memory>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/hand.h"
#include "core/hand/load_hand.h"
#include "workbench/command.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

struct FkOptions {
  std::string hand;
  std::vector<std::string> joints;  ///< "FFJ3=30"
  std::string link;                 ///< empty: the digits' last ones
  bool json = false;
};

/** Reads "FFJ3=30" into q: degrees, of a prismatic joint millimetres. What is outside the limits is
noted. */
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
  if (equals == std::string::npos || !ReadNumber(assignment.substr(equals + 1), angle_deg) ||
      !std::isfinite(angle_deg)) {
    throw Error(
        ErrorKind::kUsage,
        "\"" + assignment + "\" is not a joint angle; expected NAME=DEG, e.g. " + name + "=30");
  }
  const HandJoint& limits = hand.joints[joint];
  q[joint] = FromDisplayUnits(limits, angle_deg);
  constexpr double kTolerance = 1e-9;  // [rad] limits in degrees are not exact in radians
  if (q[joint] < limits.lower - kTolerance || q[joint] > limits.upper + kTolerance) {
    const auto format = [&](double position) {
      return FormatSignificant(ToDisplayUnits(limits, position), 4);
    };
    const std::string unit = std::string(" ") + DisplayUnitOf(limits);
    PrintMessage("note: " + name + " = " + FormatSignificant(angle_deg, 4) + unit +
                 " is outside its limits " + format(limits.lower) + " .. " + format(limits.upper) +
                 unit);
  }
}

/** In H. Frames first: a link of an imported hand lies at its joint. */
Pose FindFrame(const Hand& hand, const std::vector<Pose>& X_HL, const std::string& name) {
  std::vector<std::string> known;
  for (const NamedFrame& frame : hand.frames) {
    if (frame.name == name) return X_HL[frame.link] * frame.X_LF;
    known.push_back(frame.name);
  }
  for (const HandLink& link : hand.links) known.push_back(link.name);
  const int link = hand.FindLink(name);
  if (link >= 0) return X_HL[link];
  throw Error(ErrorKind::kUsage,
              "the " + hand.name + " has no link \"" + name + "\"" + SuggestNames(name, known));
}

/** The pose of each digit's last link, or of a link or frame of the description, in the palm's
frame. Joints that are not named are zero, coupled ones follow unless they are named.
@throws Error(kUsage) for an unknown joint or link, or no number. */
void PrintForwardKinematics(const FkOptions& options) {
  const std::string& link = options.link;
  const std::vector<std::string>& joints = options.joints;
  const Hand hand = LoadHand(options.hand);
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
  TextTable table({link.empty() ? "digit" : "link", "x [mm]", "y [mm]", "z [mm]"});
  std::vector<std::pair<std::string, Pose>> rows;  // X_H of each frame
  for (const Digit& digit : hand.digits) {
    if (link.empty()) rows.emplace_back(digit.id, X_HL[digit.distal_link]);
  }
  if (!link.empty()) rows.emplace_back(link, FindFrame(hand, X_HL, link));
  for (const auto& [name, X_HF] : rows) {
    const Pose X_PalmL = X_PalmH * X_HF;
    const Eigen::Vector3d p = X_PalmL.translation();
    Json R = Json::array();
    for (int row = 0; row < 3; ++row) R.push_back(JsonVector(X_PalmL.linear().row(row)));
    frames[name] = {{"p_m", JsonVector(p)}, {"R", R}};
    table.AddRow({name, FormatFixed(MmFromM(p.x()), 2), FormatFixed(MmFromM(p.y()), 2),
                  FormatFixed(MmFromM(p.z()), 2)});
  }
  if (options.json) return PrintJson(frames);
  PrintResult((link.empty() ? "origin of the last link of each digit, in the palm frame\n"
                            : "origin of the link, in the palm frame\n") +
              table.Format());
}

}  // namespace

void AddHandFkCommand(Command& program) {
  const auto options = std::make_shared<FkOptions>();
  Command& command =
      AddSubcommand(program.Subcommand("hand"), "fk",
                    "Compute forward kinematics: the last link of each digit in the palm frame.",
                    "  graspbench hand fk shadow --joints FFJ3=30,FFJ2=45\n"
                    "  graspbench hand fk shadow --joints THJ5=20,THJ4=40 --json");
  AddJsonOption(command, options->json);
  command.AddRequired("hand", options->hand, "id, or folder with hand.urdf and hand.yaml", "HAND");
  command
      .AddOption("--joints", options->joints,
                 "joint angles in degrees; other joints are 0, coupled joints follow",
                 "NAME=DEG,..")
      ->SplitAtCommas()
      ->OneValueEach();
  command.AddOption("--link", options->link,
                    "link or frame of the description to report instead of the last links", "NAME");
  command.SetAction([options] { PrintForwardKinematics(*options); });
}

}  // namespace graspbench
