#include "workbench/shell/shell_commands.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "core/base/error.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/load_hand.h"
#include "datasets/plan/scene_names.h"
#include "objects/catalogue.h"
#include "workbench/shell/shell.h"
#include "workbench/shell/shell_cards.h"
#include "workbench/shell/shell_picture.h"
#include "workbench/terminal/command_line.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr int kAnyNumber = 1000;
constexpr size_t kHelpWidth = 78;
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
                                       SuggestNames(given, ListCommandNames()) +
                                       " (help lists them)");
  }
  std::string text;
  for (const ShellCommand* command : beginnings) {
    text += (text.empty() ? "" : ", ") + std::string(command->name);
  }
  throw Error(ErrorKind::kUsage, "\"" + given + "\" begins several commands: " + text);
}

using Names = std::vector<std::string>;

Names ListSettings(Shell&, size_t index) {
  return index == 0 ? ListSettingKeys(SessionConfig()) : Names();
}

Names ListHandNames(Shell&, size_t index) { return index == 0 ? ListHands() : Names(); }
Names ListObjectNames(Shell&, size_t index) { return index == 0 ? ListObjects() : Names(); }

Names ListGrasps(Shell& shell, size_t index) {
  Names names = {"best", "predicted", "rehearsed", "by-sight"};
  for (const Grasp& grasp : shell.scene().grasps()) names.push_back(grasp.id);
  return index == 0 ? names : Names();
}

Names ListJoints(Shell& shell, size_t index) {
  Names names;
  for (const HandJoint& joint : shell.scene().setup().hand->joints) {
    if (index == 0 && joint.coupled_to < 0) names.push_back(joint.name);
  }
  return index == 2 ? Names{"pre", "target"} : names;
}

Names ListGraspDigits(Shell& shell, size_t index) {
  if (index == 1) return {"delay", "speed"};
  return index == 0 ? shell.scene().setup().grasp.digits : Names();
}

Names ListMovable(Shell&, size_t index) { return index == 0 ? Names{"hand", "object"} : Names(); }

Names ListTurns(Shell& shell, size_t index) {
  return index == 1 ? Names{"x", "y", "z"} : ListMovable(shell, index);
}

Names ListTargets(Shell&, size_t index) {
  Names names = ListRunTargets();
  if (index <= 1) names.emplace_back("to");
  if (index == 0) names.emplace_back("all");
  return names;
}

Names ListViews(Shell&, size_t index) { return index == 0 ? ListSceneViews() : Names(); }
Names ListShotViews(Shell&, size_t index) { return index == 1 ? ListSceneViews() : Names(); }
Names ListCards(Shell&, size_t index) { return index == 0 ? ListLiveCards() : Names(); }
Names ListSteps(Shell&, size_t index) { return index == 0 ? Names{"1", "2"} : Names(); }
Names ListPostureNames(Shell&, size_t index) { return index == 0 ? ListPostures() : Names(); }
Names ListNone(Shell&, size_t index) { return index == 0 ? Names{"none"} : Names(); }
Names ListTopics(Shell&, size_t index) { return index == 0 ? ListCommandNames() : Names(); }

/** A card of the scene is a command of its own. */
template <std::string (*kFormat)(ShellScene&)>
void ShowCard(Shell& shell, const ShellArguments&) {
  PrintResult(kFormat(shell.scene()));
}

/** Files and folders that begin with `word`, folders with a slash. */
Names ListFiles(const std::string& word) {
  const fs::path path = word;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  Names names;
  std::error_code status;
  for (const auto& entry : fs::directory_iterator(folder, status)) {
    const std::string file = entry.path().filename().string();
    if (file.rfind(path.filename().string(), 0) != 0) continue;
    if (file.front() == '.' && path.filename().empty()) continue;
    const bool is_folder = entry.is_directory(status);
    names.push_back((path.has_parent_path() ? path.parent_path() / file : fs::path(file)).string() +
                    (is_folder ? "/" : ""));
  }
  return names;
}

}  // namespace

const std::vector<ShellCommand>& ListShellCommands() {
  static const std::vector<ShellCommand> commands = {
      {"scene", kScene, "", "Show the current choice and the state of the trial.", "scene", 0, 0,
       -1, nullptr, &ShowScene},
      {"hand", kScene, "HAND", "Choose a hand by id, name or folder.", "hand shadow", 1, kAnyNumber,
       0, &ListHandNames, &ChooseHand},
      {"object", kScene, "OBJECT", "Choose an object by id, name or folder.", "object light bulb",
       1, kAnyNumber, 0, &ListObjectNames, &ChooseObject},
      {"grasp", kScene, "GRASP", "Choose a grasp: g1 to g6, a name, best, or a file.",
       "grasp power", 1, kAnyNumber, 0, &ListGrasps, &ChooseGrasp},
      {"draw", kScene, "N|none", "Choose the sampled variation of trial N (0 to 999999).", "draw 3",
       1, 1, -1, &ListNone, &ChooseDraw},
      {"move", kScene, "[object] X Y|hand X Y Z",
       "Shift object or hand from its nominal place (-200 to 200 mm).", "move hand 0 0 -5", 2, 4,
       -1, &ListMovable, &MoveThing},
      {"turn", kScene, "[object] ANGLE|hand x|y|z ANGLE",
       "Turn the object about z, or the hand about the object (deg).", "turn hand z 10", 1, 3, -1,
       &ListTurns, &TurnThing},
      {"joint", kScene, "JOINT ANGLE [pre|target]",
       "Set a joint of the target or pre-grasp posture (deg, mm).", "joint FFJ3 30", 2, 3, -1,
       &ListJoints, &SetJoint},
      {"digit", kScene, "DIGIT delay SECONDS|speed SHARE",
       "Set the closing delay [s] or relative speed of a digit.", "digit FF delay 0.05", 3, 3, -1,
       &ListGraspDigits, &SetDigit},
      {"set", kScene, "[KEY [VALUE]]", "Change or list settings; -e off: continue after errors.",
       "set model.friction_scale 0.5", 0, 2, -1, &ListSettings, &ChangeSetting},
      {"open", kScene, "DIR ID|CONDITION:N", "Open a trial of a session with its copies of inputs.",
       "open results/pilot 0123456789abcdef", 2, 2, 0, nullptr, &OpenTrial},
      {"undo", kScene, "", "Undo the last change and return to the same time.", "undo", 0, 0, -1,
       nullptr, &UndoChange},
      {"redo", kScene, "", "Redo the last undone change.", "redo", 0, 0, -1, nullptr, &RedoChange},
      {"diff", kScene, "", "List changes from the grasp and the defaults.", "diff", 0, 0, -1,
       nullptr, &ShowChanges},
      {"save", kScene, "FILE.yaml", "Save the current grasp as a grasp file.", "save my_grasp.yaml",
       1, 1, 0, nullptr, &SaveGrasp},
      {"step", kTime, "[N]", "Advance by N physics steps (1).", "step 10", 0, 1, -1, nullptr,
       &StepTrial},
      {"run", kTime, "[all] [to PHASE|contact|slip|end]",
       "Go on to there (end); all: the best grasp of every object.", "run to lift-off", 0, 3, -1,
       &ListTargets, &RunTrial},
      {"goto", kTime, "TIME", "Go to this time, earlier or later (0 to 3600 s).", "goto 1.25s", 1,
       1, -1, nullptr, &GoToTime},
      {"back", kTime, "[TIME]", "Go back by this time (0.1 s).", "back 0.5s", 0, 1, -1, nullptr,
       &GoBack},
      {"reset", kTime, "", "Return to the start.", "reset", 0, 0, -1, nullptr, &ResetTrial},
      {"drive", kTime, "JOINT ANGLE", "Command a drive to this position from now on (deg, mm).",
       "drive FFJ3 60", 2, 2, -1, &ListJoints, &DriveJoint},
      {"live", kTime, "CARD|view|off", "Show this in real time while a trial runs.",
       "live contacts", 1, 1, -1, &ListCards, &ChooseLiveCard},
      {"joints", kLook, "", "List angles, limits and commands of all joints.", "joints", 0, 0, -1,
       nullptr, &ShowCard<&FormatJoints>},
      {"contacts", kLook, "", "List contact forces and the used share of their friction cones.",
       "contacts", 0, 0, -1, nullptr, &ShowCard<&FormatContacts>},
      {"timing", kLook, "", "List first contacts, GCT, GFT and GOT.", "timing", 0, 0, -1, nullptr,
       &ShowCard<&FormatTiming>},
      {"stability", kLook, "", "Show sigma, epsilon, and the pull that the grasp resists.",
       "stability", 0, 0, -1, nullptr, &ShowCard<&FormatStability>},
      {"wrench", kLook, "", "Show the forces and moments that the contacts can exert.", "wrench", 0,
       0, -1, nullptr, &ShowCard<&FormatWrenchSpace>},
      {"pose", kLook, "[now|pre|target]",
       "Show positions and normals of the pads, and the hand opening.", "pose target", 0, 1, -1,
       &ListPostureNames, &ShowPads},
      {"view", kLook, "[grasp|front|back|left|right|top|free AZIMUTH ELEVATION [ZOOM]]",
       "Draw the scene in the terminal (deg).", "view free 45 30 1.5", 0, 4, -1, &ListViews,
       &ViewScene},
      {"shot", kLook, "FILE.png [VIEW]", "Write the same picture to a file.", "shot bulb.png top",
       1, 5, 0, &ListShotViews, &ShootScene},
      {"film", kLook, "FILE.webp [VIEW]", "Write the whole trial as an animation.",
       "film bulb.webp front", 1, 5, 0, &ListShotViews, &FilmTrial},
      {"why", kStudy, "", "Explain the outcome and name the nearest draw that succeeds.", "why", 0,
       0, -1, nullptr, &ExplainTrial},
      {"judge", kStudy, "", "Pull and twist the object until it leaves the hand.", "judge", 0, 0,
       -1, nullptr, &JudgeTrial},
      {"trials", kStudy, "[N]", "Run draws 0 to N - 1 (10) and compare with the last run.",
       "trials 20", 0, 1, -1, nullptr, &RunTrials},
      {"optimise", kStudy, "1|2 [EVALUATIONS]",
       "Learn the pre-grasp (1) or the target grasp (2, 200).", "optimise 1", 1, 2, -1, &ListSteps,
       &OptimiseTrial},
      {"report", kStudy, "FILE.html", "Write a page about the finished trial.", "report bulb.html",
       1, 1, 0, nullptr, &ReportTrial},
      {"note", kShell, "TEXT", "Write a remark into the log.", "note the thumb slips first", 1,
       kAnyNumber, -1, nullptr, &TakeNote},
      {"history", kShell, "[N]", "List the last N executed lines (20).", "history 5", 0, 1, -1,
       nullptr, &ShowHistory},
      {"help", kShell, "[COMMAND]", "List the commands, or explain one.", "help run", 0, 1, -1,
       &ListTopics, &ShowHelp},
      {"quit", kShell, "", "Leave.", "quit", 0, 0, -1, nullptr, &Leave}};
  return commands;
}

namespace {

/** What a command is for, and the names that it knows now. */
std::string FormatCommandHelp(Shell& shell, const ShellCommand& command) {
  std::string text =
      FormatUsage(command) + "\n  " + command.help + "\n  example: " + command.example + "\n";
  const Names names = command.list_names ? command.list_names(shell, 0) : Names();
  if (names.empty()) return text;
  std::string line = "  known:";
  for (const std::string& name : names) {
    if (line.size() + 1 + name.size() > kHelpWidth) {
      text += line + "\n";
      line = "        ";
    }
    line += " " + name;
  }
  return text + line + "\n";
}

}  // namespace

void RunShellCommand(Shell& shell, const std::vector<std::string>& words) {
  const ShellCommand& command = FindCommand(words.front() == "?" ? "help" : words.front());
  const ShellArguments arguments(words.begin() + 1, words.end());
  if (words.size() > 1 && words.back() == "?" && command.run != &TakeNote) {
    return PrintResult(FormatCommandHelp(shell, command));
  }
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
  std::istringstream before(line.substr(0, start));
  Names words;
  for (std::string given; before >> given;) words.push_back(given);
  Names names;
  if (words.empty()) {
    names = ListCommandNames();
  } else {
    for (const ShellCommand& command : ListShellCommands()) {
      if (MakeComparable(words.front()) != command.name) continue;
      const size_t index = words.size() - 1;
      if (command.list_names) names = command.list_names(shell, index);
      if (static_cast<int>(index) != command.file_argument) continue;
      for (const std::string& file : ListFiles(word)) names.push_back(file);
    }
  }
  names.erase(std::remove_if(names.begin(), names.end(),
                             [&](const std::string& name) { return name.rfind(word, 0) != 0; }),
              names.end());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

void ShowHelp(Shell& shell, const ShellArguments& arguments) {
  if (!arguments.empty()) {
    return PrintResult(FormatCommandHelp(shell, FindCommand(arguments[0])));
  }
  std::string text, group;
  for (const ShellCommand& command : ListShellCommands()) {
    if (group != command.group)
      text += (group.empty() ? "" : "\n") + std::string(command.group) + "\n";
    group = command.group;
    text += fmt::format("  {:<10} {}\n", command.name, command.help);
  }
  PrintResult(text +
              "\nhelp COMMAND, or COMMAND ?, explains a command. Commands may be abbreviated: con, "
              "sta.\nCtrl-C stops a running command.\n");
}

void ShowHistory(Shell& shell, const ShellArguments& arguments) {
  const std::vector<std::string>& lines = shell.script();
  const auto count = static_cast<size_t>(
      arguments.empty() ? 20 : ParseCount(arguments[0], "the number of lines", 1, 1000000));
  std::string text;
  for (size_t i = lines.size() - std::min(count, lines.size()); i < lines.size(); ++i) {
    text += fmt::format("{:>4}  {}\n", i + 1, lines[i]);
  }
  PrintResult(text.empty() ? "no line was executed yet\n" : text);
}

void TakeNote(Shell&, const ShellArguments&) {}

void Leave(Shell& shell, const ShellArguments&) { shell.Quit(); }

}  // namespace graspbench
