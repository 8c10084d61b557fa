#include "workbench/shell/shell_commands.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/load_hand.h"
#include "objects/catalogue.h"
#include "workbench/shell/shell.h"
#include "workbench/shell/shell_picture.h"
#include "workbench/shell/shell_words.h"
#include "workbench/terminal.h"

namespace graspbench {
namespace {

constexpr int kAnyNumber = 1000;
constexpr char kScene[] = "the scene", kTime[] = "time", kLook[] = "look", kStudy[] = "study",
               kShell[] = "the shell";

std::string FormatUsage(const ShellCommand& command) {
  const std::string arguments = command.arguments;
  return command.name + (arguments.empty() ? "" : " " + arguments);
}

std::vector<std::string> ListCommandNames() {
  std::vector<std::string> names;
  for (const ShellCommand& command : ListShellCommands()) names.emplace_back(command.name);
  return names;
}

const ShellCommand& FindCommand(const std::string& given) {
  const std::string wanted = MakeComparable(given == "exit" ? "quit" : given);
  std::vector<const ShellCommand*> beginnings;
  for (const ShellCommand& command : ListShellCommands()) {
    if (wanted == command.name) return command;
    if (std::string(command.name).rfind(wanted, 0) == 0) beginnings.push_back(&command);
  }
  if (beginnings.size() == 1) return *beginnings.front();
  if (beginnings.empty()) {
    throw Error(ErrorKind::kUsage, "unknown command \"" + given + "\"" +
                                       SuggestNames(given, ListCommandNames()) + "; see: help");
  }
  std::string text;
  for (const ShellCommand* command : beginnings) {
    text += (text.empty() ? "" : ", ") + std::string(command->name);
  }
  throw Error(ErrorKind::kUsage, "\"" + given + "\" begins several commands: " + text);
}

std::vector<std::string> ListSettings() {
  std::vector<std::string> keys;
  const Json config = ToJson(SessionConfig());
  for (const auto& [block, values] : config.items()) {
    if (!values.is_object()) continue;
    for (const auto& [key, value] : values.items()) keys.push_back(block + "." + key);
  }
  return keys;
}

std::vector<std::string> ListGrasps(Shell& shell) {
  std::vector<std::string> names = {"best"};
  for (const StandardGrasp& grasp : shell.scene().grasps()) names.push_back(grasp.id);
  return names;
}

std::vector<std::string> ListOwnJoints(Shell& shell) {
  std::vector<std::string> names;
  for (const HandJoint& joint : shell.scene().setup().hand->joints) {
    if (joint.coupled_to < 0) names.push_back(joint.name);
  }
  return names;
}

}  // namespace

const std::vector<ShellCommand>& ListShellCommands() {
  static const std::vector<ShellCommand> commands = {
      {"scene", kScene, "", "Say what is chosen and where the trial stands.", "scene", 0, 0,
       nullptr, &ShowScene},
      {"hand", kScene, "HAND", "Take another hand, by id, name or folder.", "hand shadow", 1,
       kAnyNumber, [](Shell&) { return ListHands(); }, &ChooseHand},
      {"object", kScene, "OBJECT", "Take another object, by id, name or folder.",
       "object light bulb", 1, kAnyNumber, [](Shell&) { return ListObjects(); }, &ChooseObject},
      {"grasp", kScene, "GRASP", "Take another grasp: g1 to g5, a name, best, or a file.",
       "grasp power", 1, kAnyNumber, &ListGrasps, &ChooseGrasp},
      {"draw", kScene, "N|none", "Take the variation of trial N of a session (0 to 999999).",
       "draw 3", 1, 1, nullptr, &ChooseDraw},
      {"move", kScene, "X Y", "Put the object beside its nominal place (-200 to 200 mm).",
       "move 10 -5", 2, 2, nullptr, &MoveObject},
      {"turn", kScene, "ANGLE", "Turn the object about the vertical (-180 to 180 deg).", "turn 30",
       1, 1, nullptr, &TurnObject},
      {"joint", kScene, "JOINT ANGLE [pre|target]",
       "Set a joint of the target or pre-grasp posture (deg, mm).", "joint FFJ3 30", 2, 3,
       &ListOwnJoints, &SetJoint},
      {"set", kScene, "[KEY [VALUE]]", "Change a setting of session files, or list them.",
       "set model.friction_scale 0.5", 0, 2, [](Shell&) { return ListSettings(); }, &ChangeSetting},
      {"open", kScene, "DIR ID", "Take a trial of a session, with its copies of inputs.",
       "open results/pilot 0123456789abcdef", 2, 2, nullptr, &OpenTrial},
      {"undo", kScene, "", "Take the last change back and go to the same time.", "undo", 0, 0,
       nullptr, &UndoChange},
      {"diff", kScene, "", "Say what differs from the grasp and the defaults.", "diff", 0, 0,
       nullptr, &ShowChanges},
      {"save", kScene, "FILE.yaml", "Write the grasp as it is now as a grasp file.",
       "save my_grasp.yaml", 1, 1, nullptr, &SaveGrasp},
      {"step", kTime, "[N]", "Go on by N steps of the physics (1).", "step 10", 0, 1, nullptr,
       &StepTrial},
      {"run", kTime, "[to PHASE|contact|slip|end]",
       "Go on to there (end); slips count from lift-off on.", "run to lift-off", 0, 2,
       [](Shell&) { return ListRunTargets(); }, &RunTrial},
      {"goto", kTime, "TIME", "Stand at this time, earlier or later (0 to 3600 s).", "goto 1.25s",
       1, 1, nullptr, &GoToTime},
      {"back", kTime, "[TIME]", "Go back by so much (0.1 s).", "back 0.5s", 0, 1, nullptr, &GoBack},
      {"reset", kTime, "", "Stand at the start.", "reset", 0, 0, nullptr, &ResetTrial},
      {"joints", kLook, "", "Angles, limits and commands of all joints.", "joints", 0, 0, nullptr,
       &ShowJoints},
      {"contacts", kLook, "", "Forces on the object, with the share of their cones.", "contacts", 0,
       0, nullptr, &ShowContacts},
      {"timing", kLook, "", "First touches, GCT, GFT and GOT.", "timing", 0, 0, nullptr,
       &ShowTiming},
      {"stability", kLook, "", "Sigma, epsilon, and the pull that the grasp stands.", "stability",
       0, 0, nullptr, &ShowStability},
      {"view", kLook, "[grasp|front|back|left|right|top|free AZIMUTH ELEVATION [ZOOM]]",
       "Draw the scene into the terminal (deg).", "view free 45 30 1.5", 0, 4,
       [](Shell&) { return ListSceneViews(); }, &ViewScene},
      {"shot", kLook, "FILE.png [VIEW]", "Write the same picture to a file.", "shot bulb.png top",
       1, 5, nullptr, &ShootScene},
      {"trials", kStudy, "[N]", "Run the draws 0 to N - 1 (10); compares with before.", "trials 20",
       0, 1, nullptr, &RunTrials},
      {"judge", kStudy, "", "Pull and twist the object until it leaves the hand.", "judge", 0, 0,
       nullptr, &JudgeTrial},
      {"why", kStudy, "", "Say why it ended so, and the nearest draw that succeeds.", "why", 0, 0,
       nullptr, &ExplainTrial},
      {"note", kShell, "TEXT", "Keep a remark in the log.", "note the thumb slips first", 1,
       kAnyNumber, nullptr, &TakeNote},
      {"help", kShell, "[COMMAND]", "List the commands, or explain one.", "help run", 0, 1,
       [](Shell&) { return ListCommandNames(); }, &ShowHelp},
      {"quit", kShell, "", "Leave.", "quit", 0, 0, nullptr, &Leave}};
  return commands;
}

void RunShellCommand(Shell& shell, const std::vector<std::string>& words) {
  const ShellCommand& command = FindCommand(words.front() == "?" ? "help" : words.front());
  const ShellArguments arguments(words.begin() + 1, words.end());
  const int count = static_cast<int>(arguments.size());
  if (count < command.min_arguments || count > command.max_arguments) {
    throw Error(ErrorKind::kUsage,
                std::string(count < command.min_arguments ? "too few" : "too many") +
                    " words; expected: " + FormatUsage(command) +
                    ", for example: " + command.example);
  }
  command.run(shell, arguments);
}

std::vector<std::string> FindCompletions(Shell& shell, const std::string& line) {
  const size_t start = line.find_last_of(" \t") + 1;  // npos + 1 is 0
  const std::string word = line.substr(start);
  std::vector<std::string> names;
  if (line.find_first_not_of(" \t") >= start) {
    names = ListCommandNames();
  } else {
    const std::string first = line.substr(line.find_first_not_of(" \t"));
    for (const ShellCommand& command : ListShellCommands()) {
      if (first.substr(0, first.find_first_of(" \t")) != command.name) continue;
      if (command.list_names) names = command.list_names(shell);
    }
  }
  names.erase(std::remove_if(names.begin(), names.end(),
                             [&](const std::string& name) { return name.rfind(word, 0) != 0; }),
              names.end());
  std::sort(names.begin(), names.end());
  return names;
}

void ShowHelp(Shell&, const ShellArguments& arguments) {
  if (!arguments.empty()) {
    const ShellCommand& command = FindCommand(arguments[0]);
    return PrintResult(FormatUsage(command) + "\n  " + command.help +
                       "\n  example: " + command.example + "\n");
  }
  std::string text, group;
  for (const ShellCommand& command : ListShellCommands()) {
    if (group != command.group)
      text += (group.empty() ? "" : "\n") + std::string(command.group) + "\n";
    group = command.group;
    text += fmt::format("  {:<10} {}\n", command.name, command.help);
  }
  PrintResult(
      text +
      "\nhelp COMMAND says more. Beginnings are enough: con, sta. Ctrl-C stops what runs.\n");
}

void TakeNote(Shell&, const ShellArguments&) {}

void Leave(Shell& shell, const ShellArguments&) { shell.Quit(); }

}  // namespace graspbench
