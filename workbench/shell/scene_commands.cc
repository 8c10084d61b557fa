#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/grasp/grasp_file.h"
#include "core/hand/load_hand.h"
#include "datasets/session/session_plan.h"
#include "datasets/session/session_store.h"
#include "objects/catalogue.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/shell/shell.h"
#include "workbench/shell/shell_cards.h"
#include "workbench/shell/shell_commands.h"
#include "workbench/shell/shell_words.h"
#include "workbench/terminal.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr double kMaxOffset_mm = 200.0;

/** "light bulb" given as two words is one name. */
std::string JoinName(const ShellArguments& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

/** A known id by its id or name, in any case; what is none of them, a path perhaps, as it is. */
std::string FindId(const std::string& given, const std::vector<std::string>& ids,
                   std::string (*find_name)(const std::string& id)) {
  const std::string wanted = MakeComparable(given);
  for (const std::string& id : ids) {
    if (wanted == id) return id;
  }
  if (given.find('/') != given.npos || fs::exists(given)) return given;
  for (const std::string& id : ids) {
    if (wanted == MakeComparable(find_name(id))) return id;
  }
  return given;
}

/** One trial has one of each. */
void RefuseAll(const std::string& name) {
  if (MakeComparable(name) == "all") {
    throw Error(ErrorKind::kUsage, "\"all\" is for sessions; expected one");
  }
}

std::string FindGraspId(const std::string& given) {
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    if (MakeComparable(given) == MakeComparable(taxon.name)) return taxon.id;
    if (MakeComparable(given) == taxon.id) return taxon.id;
  }
  return given;
}

void Take(Shell& shell, const SceneChoice& choice) {
  shell.Change(choice);
  ShowScene(shell, {});
}

}  // namespace

void ChooseHand(Shell& shell, const ShellArguments& arguments) {
  RefuseAll(JoinName(arguments));
  SceneChoice choice = shell.scene().choice();
  choice.config.hands = {FindId(JoinName(arguments), ListHands(),
                                [](const std::string& id) { return LoadHand(id).name; })};
  choice.joints.clear();
  choice.folder.clear();
  Take(shell, choice);
}

void ChooseObject(Shell& shell, const ShellArguments& arguments) {
  RefuseAll(JoinName(arguments));
  SceneChoice choice = shell.scene().choice();
  choice.config.objects = {FindId(JoinName(arguments), ListObjects(), [](const std::string& id) {
    return LoadObject(id, FieldUse::kLater)->name;
  })};
  choice.place.reset();
  choice.folder.clear();
  if (choice.config.grasps.front() == "best") choice.joints.clear();  // of another grasp perhaps
  Take(shell, choice);
}

void ChooseGrasp(Shell& shell, const ShellArguments& arguments) {
  RefuseAll(JoinName(arguments));
  SceneChoice choice = shell.scene().choice();
  choice.config.grasps = {FindGraspId(JoinName(arguments))};
  choice.joints.clear();
  Take(shell, choice);
}

void ChooseDraw(Shell& shell, const ShellArguments& arguments) {
  SceneChoice choice = shell.scene().choice();
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

}  // namespace

void MoveObject(Shell& shell, const ShellArguments& arguments) {
  SceneChoice choice = shell.scene().choice();
  ObjectPlace place = FindPlace(shell);
  place.x = MFromMm(ParseNumber(arguments[0], "x", "mm", -kMaxOffset_mm, kMaxOffset_mm));
  place.y = MFromMm(ParseNumber(arguments[1], "y", "mm", -kMaxOffset_mm, kMaxOffset_mm));
  choice.place = place;
  Take(shell, choice);
}

void TurnObject(Shell& shell, const ShellArguments& arguments) {
  SceneChoice choice = shell.scene().choice();
  ObjectPlace place = FindPlace(shell);
  place.yaw = RadFromDeg(ParseNumber(arguments[0], "the angle", "deg", -180.0, 180.0));
  choice.place = place;
  Take(shell, choice);
}

void SetJoint(Shell& shell, const ShellArguments& arguments) {
  const Hand& hand = *shell.scene().setup().hand;
  JointEdit edit;
  std::vector<std::string> known;
  for (const HandJoint& joint : hand.joints) {
    if (joint.coupled_to < 0) known.push_back(joint.name);
    if (MakeComparable(joint.name) != MakeComparable(arguments[0])) continue;
    edit.joint = joint.name;
    if (joint.coupled_to >= 0) {
      throw Error(ErrorKind::kUsage, "joint " + joint.name + " follows " +
                                         hand.joints[joint.coupled_to].name + "; set that one");
    }
    edit.position =
        FromShown(joint, ParseNumber(arguments[1], "the position of " + joint.name, UnitOf(joint),
                                     ToShown(joint, joint.lower), ToShown(joint, joint.upper)));
  }
  if (edit.joint.empty()) {
    throw Error(ErrorKind::kNotFound, "the " + hand.name + " has no joint \"" + arguments[0] +
                                          "\"" + SuggestNames(arguments[0], known));
  }
  const std::string posture = arguments.size() > 2 ? ToLower(arguments[2]) : "target";
  if (posture != "target" && posture != "pre") {
    throw Error(ErrorKind::kUsage, "the posture is \"" + posture + "\"; expected pre or target");
  }
  edit.is_target = posture == "target";
  SceneChoice choice = shell.scene().choice();
  const auto is_same = [&edit](const JointEdit& other) {
    return other.joint == edit.joint && other.is_target == edit.is_target;
  };
  auto& joints = choice.joints;
  joints.erase(std::remove_if(joints.begin(), joints.end(), is_same), joints.end());
  joints.push_back(edit);
  Take(shell, choice);
}

namespace {

/** "sim.step_s 0.002" of all settings whose names hold `part`. */
std::string FormatSettings(const SessionConfig& config, const std::string& part) {
  std::string text;
  const Json settings = ToJson(config);
  for (const auto& [block, values] : settings.items()) {
    if (!values.is_object() && block != "seed") continue;
    const Json named = values.is_object() ? values : Json{{"", values}};
    for (const auto& [key, value] : named.items()) {
      const std::string name = key.empty() ? block : block + "." + key;
      if (name.find(part) != name.npos) text += name + " " + value.dump() + "\n";
    }
  }
  return text;
}

}  // namespace

void ChangeSetting(Shell& shell, const ShellArguments& arguments) {
  SceneChoice choice = shell.scene().choice();
  const std::string key = arguments.empty() ? "" : ToLower(arguments[0]);
  for (const char* own : {"hands", "objects", "grasps", "trials"}) {
    if (key != own) continue;
    throw Error(ErrorKind::kUsage, "\"" + key + "\" is no setting of one trial; see: help");
  }
  const std::string known = FormatSettings(choice.config, key);
  if (known.empty()) {
    throw Error(ErrorKind::kUsage, "no setting has \"" + key + "\" in its name; set lists them");
  }
  if (arguments.size() < 2) return PrintResult(known);
  ApplySetting(key + "=" + arguments[1], choice.config);
  Take(shell, choice);
}

namespace {

/** As the session's list names what it has loaded; "all" names nothing. */
std::string FindListed(const std::vector<std::string>& listed, size_t num_loaded, size_t index,
                       const std::string& id) {
  return listed.size() == num_loaded ? listed[index] : id;
}

/** The session's own names of one trial's things, for which it holds copies of what is not ours. */
SceneChoice NarrowTo(const Session& session, const PlannedTrial& planned) {
  SceneChoice choice;
  choice.config = session.config;
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
  std::vector<std::string> ids;
  for (const PlannedTrial& planned : session.plan) {
    if (planned.id == ToLower(arguments[1])) return Take(shell, NarrowTo(session, planned));
    ids.push_back(planned.id);
  }
  throw Error(ErrorKind::kNotFound, "the session has no trial \"" + arguments[1] + "\"" +
                                        SuggestNames(arguments[1], ids) +
                                        "; the column trial_id of trials.csv has them");
}

void UndoChange(Shell& shell, const ShellArguments&) {
  shell.Undo();
  ShowScene(shell, {});
}

void ShowChanges(Shell& shell, const ShellArguments&) {
  const SceneChoice& choice = shell.scene().choice();
  const Hand& hand = *shell.scene().setup().hand;
  std::string text;
  if (choice.place) {
    text += fmt::format(
        "place    x {} mm, y {} mm, yaw {} deg\n", FormatFixed(MmFromM(choice.place->x), 1),
        FormatFixed(MmFromM(choice.place->y), 1), FormatFixed(DegFromRad(choice.place->yaw), 1));
  }
  const StandardGrasp grasp = shell.scene().unedited_grasp();
  for (const JointEdit& edit : choice.joints) {
    const int index = hand.FindJoint(edit.joint);
    const HandJoint& joint = hand.joints[static_cast<size_t>(index)];
    const Eigen::VectorXd& q = edit.is_target ? grasp.q_target : grasp.q_pre;
    text += fmt::format("joint    {} {} {} {}, the grasp's {} {}\n", edit.joint,
                        FormatFixed(ToShown(joint, edit.position), 1), UnitOf(joint),
                        edit.is_target ? "target" : "pre", FormatFixed(ToShown(joint, q[index]), 1),
                        UnitOf(joint));
  }
  std::istringstream now(FormatSettings(choice.config, "")), before(FormatSettings({}, ""));
  for (std::string line, other; std::getline(now, line) && std::getline(before, other);) {
    if (line == other) continue;
    text += "set      " + line + ", default" + other.substr(other.find(' ')) + "\n";
  }
  PrintResult(text.empty() ? "nothing differs from the grasp and the session's defaults\n" : text);
}

void SaveGrasp(Shell& shell, const ShellArguments& arguments) {
  const std::string& file = arguments[0];
  if (fs::path(file).extension() != ".yaml") {
    throw Error(ErrorKind::kUsage, "\"" + file + "\" does not end in .yaml, as grasp files do");
  }
  CheckOutputFile(file);
  const TrialSetup& setup = shell.scene().setup();
  StandardGrasp grasp = setup.grasp;
  const std::string made_from = grasp.id;
  grasp.id = MakePlainKey({fs::path(file).stem().string()});
  WriteFileAtomically(file, FormatGraspFile(*setup.hand, grasp, made_from));
  PrintResult(file + "\nnext     graspbench run --hand " + setup.hand->id + " --object " +
              setup.object->id + " --grasp best," + file + "\n");
}

}  // namespace graspbench
