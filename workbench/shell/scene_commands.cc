#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/grasp_file.h"
#include "core/hand/load_hand.h"
#include "datasets/plan/conditions.h"
#include "datasets/plan/grip_check.h"
#include "datasets/plan/scene_names.h"
#include "datasets/plan/session_plan.h"
#include "datasets/session/find_trial.h"
#include "datasets/session/session_store.h"
#include "objects/catalogue.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/shell/shell.h"
#include "workbench/shell/shell_cards.h"
#include "workbench/shell/shell_commands.h"
#include "workbench/terminal/command_line.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr double kMaxOffset_mm = 200.0;
/** Of a digit's closing, as grasp files have them. */
constexpr double kMaxDelay = 10.0;  // [s]
constexpr double kMinSpeed = 0.05, kMaxSpeed = 10.0;
constexpr double kPrintedExact = 1e-6;  // of a joint position as it is shown

/** "light bulb" given as two words is one name. */
std::string JoinName(const ShellArguments& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

/** One trial has one of each. */
void RefuseAll(const std::string& name) {
  if (MakeComparable(name) == "all") {
    throw Error(ErrorKind::kUsage, "\"all\" is for sessions; expected one");
  }
}

/** What was changed by hand belongs to one grasp. */
void ForgetEdits(SceneChoice& choice) {
  choice.joints.clear();
  choice.closing.clear();
  choice.drives.clear();
  choice.hand_place.reset();
  choice.learned.reset();
}

void Take(Shell& shell, const SceneChoice& choice) {
  shell.Change(choice);
  ShowScene(shell, {});
}

}  // namespace

void ChooseHand(Shell& shell, const ShellArguments& arguments) {
  RefuseAll(JoinName(arguments));
  SceneChoice choice = shell.choice();
  choice.config.hands = {FindHandId(JoinName(arguments))};
  ForgetEdits(choice);
  choice.folder.clear();
  Take(shell, choice);
}

void ChooseObject(Shell& shell, const ShellArguments& arguments) {
  RefuseAll(JoinName(arguments));
  SceneChoice choice = shell.choice();
  choice.config.objects = {FindObjectId(JoinName(arguments))};
  choice.place.reset();
  choice.folder.clear();
  const std::string& grasp = choice.config.grasps.front();
  if (grasp == kBestGrasp || grasp == kPredictedGrasp || choice.learned) {
    ForgetEdits(choice);  // of another grasp perhaps
  }
  Take(shell, choice);
}

void ChooseGrasp(Shell& shell, const ShellArguments& arguments) {
  RefuseAll(JoinName(arguments));
  SceneChoice choice = shell.choice();
  choice.config.grasps = {FindGraspId(JoinName(arguments))};
  choice.config = SessionConfigFromJson(ToJson(choice.config));  // no camera that is not used
  ForgetEdits(choice);
  Take(shell, choice);
}

void ChooseDraw(Shell& shell, const ShellArguments& arguments) {
  SceneChoice choice = shell.choice();
  choice.place.reset();
  choice.draw.reset();
  if (ToLower(arguments.front()) != "none") {
    choice.draw = ParseCount(arguments.front(), "the draw", 0, 999999);
  }
  Take(shell, choice);
}

namespace {

/** Where the object stands at the start, as a place to change. */
ObjectPlace FindPlace(Shell& shell) {
  const TrialDraw& draw = shell.scene().setup().draw;
  return {draw.offset_x, draw.offset_y, draw.offset_yaw};
}

/** Which of the two "hand" or "object" names at the front; the object without a word. */
bool TakesHand(ShellArguments& arguments) {
  const std::string word = ToLower(arguments.front());
  if (word != "hand" && word != "object") return false;
  arguments.erase(arguments.begin());
  return word == "hand";
}

[[noreturn]] void FailUsage(const std::string& expected) {
  throw Error(ErrorKind::kUsage, "expected: " + expected);
}

}  // namespace

void MoveThing(Shell& shell, const ShellArguments& given) {
  ShellArguments arguments = given;
  SceneChoice choice = shell.scene().choice();
  const bool is_hand = TakesHand(arguments);
  if (arguments.size() != (is_hand ? 3u : 2u)) FailUsage("move [object] X Y, or move hand X Y Z");
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < arguments.size(); ++i) {
    shift[static_cast<Eigen::Index>(i)] =
        MFromMm(ParseNumber(arguments[i], std::string(1, static_cast<char>('x' + i)), "mm",
                            -kMaxOffset_mm, kMaxOffset_mm));
  }
  if (is_hand) {
    if (!choice.hand_place) choice.hand_place.emplace();
    choice.hand_place->shift = shift;
  } else {
    ObjectPlace place = FindPlace(shell);
    place.x = shift.x();
    place.y = shift.y();
    choice.place = place;
  }
  Take(shell, choice);
}

void TurnThing(Shell& shell, const ShellArguments& given) {
  ShellArguments arguments = given;
  SceneChoice choice = shell.scene().choice();
  const bool is_hand = TakesHand(arguments);
  if (arguments.size() != (is_hand ? 2u : 1u)) {
    FailUsage("turn [object] ANGLE, or turn hand x|y|z ANGLE");
  }
  const double angle = RadFromDeg(ParseNumber(arguments.back(), "the angle", "deg", -180.0, 180.0));
  if (is_hand) {
    const std::string axis = ToLower(arguments.front());
    if (axis != "x" && axis != "y" && axis != "z") {
      throw Error(ErrorKind::kUsage,
                  "the axis is \"" + arguments.front() + "\"; expected x, y or z");
    }
    if (!choice.hand_place) choice.hand_place.emplace();
    choice.hand_place->angles[axis.front() - 'x'] = angle;
  } else {
    ObjectPlace place = FindPlace(shell);
    place.yaw = angle;
    choice.place = place;
  }
  Take(shell, choice);
}

namespace {

struct NamedPosition {
  std::string joint;
  double position = 0.0;  // [rad], of a prismatic joint [m]
};

/** @throws Error(kNotFound, kUsage) for a joint without a drive of its own or outside its limits. */
NamedPosition ParseJoint(const Hand& hand, const std::string& name, const std::string& number) {
  std::vector<std::string> known;
  for (const HandJoint& joint : hand.joints) {
    if (joint.coupled_to < 0) known.push_back(joint.name);
    if (MakeComparable(joint.name) != MakeComparable(name)) continue;
    if (joint.coupled_to >= 0) {
      throw Error(ErrorKind::kUsage, "joint " + joint.name + " follows " +
                                         hand.joints[joint.coupled_to].name + "; set that one");
    }
    // The limits as they are printed are within them, whatever the last bits are.
    const double shown = ParseNumber(number, "the position of " + joint.name, DisplayUnitOf(joint),
                                     ToDisplayUnits(joint, joint.lower) - kPrintedExact,
                                     ToDisplayUnits(joint, joint.upper) + kPrintedExact);
    return {joint.name, std::clamp(FromDisplayUnits(joint, shown), joint.lower, joint.upper)};
  }
  throw Error(ErrorKind::kNotFound,
              "the " + hand.name + " has no joint \"" + name + "\"" + SuggestNames(name, known));
}

}  // namespace

void SetJoint(Shell& shell, const ShellArguments& arguments) {
  const NamedPosition given = ParseJoint(*shell.scene().setup().hand, arguments[0], arguments[1]);
  const std::string posture = arguments.size() > 2 ? ToLower(arguments[2]) : "target";
  if (posture != "target" && posture != "pre") {
    throw Error(ErrorKind::kUsage, "the posture is \"" + posture + "\"; expected pre or target");
  }
  const JointEdit edit = {posture == "target", given.joint, given.position};
  SceneChoice choice = shell.scene().choice();
  const auto is_same = [&edit](const JointEdit& other) {
    return other.joint == edit.joint && other.is_target == edit.is_target;
  };
  auto& joints = choice.joints;
  joints.erase(std::remove_if(joints.begin(), joints.end(), is_same), joints.end());
  joints.push_back(edit);
  Take(shell, choice);
}

void SetDigit(Shell& shell, const ShellArguments& arguments) {
  const Grasp& grasp = shell.scene().setup().grasp;
  const auto digit = std::find_if(
      grasp.digits.begin(), grasp.digits.end(),
      [&](const std::string& id) { return MakeComparable(id) == MakeComparable(arguments[0]); });
  if (digit == grasp.digits.end()) {
    throw Error(ErrorKind::kNotFound, "no digit of the grasp is \"" + arguments[0] + "\"" +
                                          SuggestNames(arguments[0], grasp.digits));
  }
  SceneChoice choice = shell.scene().choice();
  const auto own = grasp.closing.find(*digit);
  ClosingSchedule schedule = own == grasp.closing.end() ? ClosingSchedule() : own->second;
  const std::string what = ToLower(arguments[1]);
  if (what == "delay") {
    schedule.delay = ParseNumber(arguments[2], "the delay of " + *digit, "s", 0.0, kMaxDelay);
  } else if (what == "speed") {
    schedule.speed = ParseNumber(arguments[2], "the speed of " + *digit, "", kMinSpeed, kMaxSpeed);
  } else {
    FailUsage("digit DIGIT delay SECONDS, or digit DIGIT speed SHARE");
  }
  choice.closing[*digit] = schedule;
  Take(shell, choice);
}

void DriveJoint(Shell& shell, const ShellArguments& arguments) {
  ShellScene& scene = shell.scene();
  const NamedPosition given = ParseJoint(*scene.setup().hand, arguments[0], arguments[1]);
  if (scene.is_over()) {
    throw Error(ErrorKind::kUsage, "the trial has ended; back or goto return to an earlier time");
  }
  SceneChoice choice = scene.choice();
  std::vector<DriveEdit>& drives = choice.drives;
  // What was asked for later belongs to another course.
  while (!drives.empty() && drives.back().time > scene.time()) drives.pop_back();
  drives.push_back({scene.time(), given.joint, given.position});
  shell.ChangeNow(choice);
  PrintResult(FormatStatus(scene));
}

namespace {

/** "0.002s" for a key that ends in _s is 0.002, as everywhere in the shell. */
std::string TakeUnitOff(const std::string& key, const std::string& value) {
  const std::string unit = key.substr(key.find_last_of("_.") + 1);
  if (unit.size() >= value.size() || key.find('_') == key.npos) return value;
  const std::string number = value.substr(0, value.size() - unit.size());
  const bool has_unit = ToLower(value.substr(number.size())) == unit;
  return has_unit && std::isdigit(static_cast<unsigned char>(number.back())) ? number : value;
}

}  // namespace

void ChangeSetting(Shell& shell, const ShellArguments& arguments) {
  if (!arguments.empty() && arguments[0] == "-e") {
    if (arguments.size() < 2 || (arguments[1] != "on" && arguments[1] != "off")) {
      throw Error(ErrorKind::kUsage,
                  "expected set -e on (a script stops at its first error) or off");
    }
    return shell.StopAtErrors(arguments[1] == "on");
  }
  SceneChoice choice = shell.scene().choice();
  const std::string key = arguments.empty() ? "" : ToLower(arguments[0]);
  for (const char* own : {"hands", "objects", "grasps", "trials"}) {
    if (key != own) continue;
    throw Error(ErrorKind::kUsage, "\"" + key + "\" is not a setting of one trial; see: help");
  }
  const std::string known = FormatSettings(choice.config, key);
  if (known.empty()) {
    throw Error(ErrorKind::kUsage, "no setting name contains \"" + key + "\"" +
                                       SuggestNames(key, ListSettingKeys(choice.config)) +
                                       " (set lists them)");
  }
  if (arguments.size() < 2) return PrintResult(known);
  const std::string setting = key + "=" + TakeUnitOff(key, arguments[1]);
  ApplySetting(setting, choice.config);
  RefuseUnusedGrip(setting, choice.config.strategy);
  Take(shell, choice);
}

namespace {

/** As the session's list names what it has loaded; "all" names nothing. */
std::string FindListed(const std::vector<std::string>& listed, size_t num_loaded, size_t index,
                       const std::string& id) {
  return listed.size() == num_loaded ? listed[index] : id;
}

/** The session as it is configured, or under a condition.
@throws Error(kUnsupported) for a condition that is no setting of a scene. */
SessionConfig FindConfig(const Session& session, const PlannedTrial& planned) {
  if (!planned.condition) {
    SessionConfig config = session.config;
    config.conditions.clear();
    return config;
  }
  const auto condition =
      std::find_if(session.config.conditions.begin(), session.config.conditions.end(),
                   [&](const Condition& c) { return c.name == planned.condition; });
  const ConditionInputs made = ApplyCondition(*condition, session.config);
  if (made.late == LateDigit::kNone && !made.is_compliant) return made.config;
  throw Error(
      ErrorKind::kUnsupported,
      "the trial " + NameTrial(planned) + " " +
          (made.is_compliant ? "was simulated by the compliant backend" : "closes a digit late") +
          ", which the shell does not do; see: graspbench trial " +
          QuoteForShell(session.folder.string()) + " " + planned.id);
}

/** The session's own names of one trial's things, for which it holds copies of what is not ours. */
SceneChoice NarrowTo(const Session& session, const PlannedTrial& planned) {
  SceneChoice choice;
  choice.config = FindConfig(session, planned);
  choice.folder = session.folder.string();
  choice.draw = planned.trial;
  const SessionInputs inputs = LoadSessionInputs(session.config, FieldUse::kLater, choice.folder);
  for (size_t i = 0; i < inputs.hands.size(); ++i) {
    if (inputs.hands[i].hand->id != planned.hand) continue;
    choice.config.hands = {FindListed(session.config.hands, inputs.hands.size(), i, planned.hand)};
  }
  for (size_t i = 0; i < inputs.objects.size(); ++i) {
    if (inputs.objects[i]->id != planned.object) continue;
    choice.config.objects = {
        FindListed(session.config.objects, inputs.objects.size(), i, planned.object)};
  }
  choice.config.grasps = {planned.grasp};
  for (const auto& [file, id] : inputs.grasp_files) {
    if (id == planned.grasp) choice.config.grasps = {file};
  }
  return choice;
}

}  // namespace

void OpenTrial(Shell& shell, const ShellArguments& arguments) {
  const Session session = LoadSession(arguments[0], OnDamage::kRefuse, RecordParts::kBrief);
  Take(shell, NarrowTo(session, FindPlannedTrial(session, arguments[1])));
}

void UndoChange(Shell& shell, const ShellArguments&) {
  shell.Undo();
  ShowScene(shell, {});
}

void RedoChange(Shell& shell, const ShellArguments&) {
  shell.Redo();
  ShowScene(shell, {});
}

void ShowChanges(Shell& shell, const ShellArguments&) {
  const std::string text = FormatChanges(shell.scene());
  PrintResult(text.empty() ? "no change from the grasp and the defaults of a session\n" : text);
}

void SaveGrasp(Shell& shell, const ShellArguments& arguments) {
  const std::string& file = arguments[0];
  if (fs::path(file).extension() != ".yaml") {
    throw Error(ErrorKind::kUsage, "\"" + file + "\" does not end in .yaml, as grasp files do");
  }
  CheckOutputFile(file);
  const TrialSetup& setup = shell.scene().setup();
  Grasp grasp = setup.grasp;
  const std::string made_from = FindStandardId(grasp);
  grasp.id = MakePlainKey({fs::path(file).stem().string()});
  WriteFileAtomically(file, FormatGraspFile(*setup.hand, grasp, made_from));
  PrintResult(file + "\nnext     graspbench run --hand " + setup.hand->id + " --object " +
              setup.object->id + " --grasp best," + file + "\n");
}

}  // namespace graspbench
