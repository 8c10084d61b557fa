#include "workbench/robot_export.h"

#include <fmt/format.h>

#include <set>

#include "core/base/files/files.h"
#include "core/trial/trial_runner.h"
#include "datasets/mjcf/arm_urdf.h"
#include "datasets/mjcf/mjcf_export.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/session/find_trial.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"

namespace graspbench {
namespace {

/** The trials that are asked for, in the plan's order. */
std::vector<PlannedTrial> FindTrials(const Session& session,
                                     const std::vector<std::string>& names) {
  if (names == std::vector<std::string>{"all"}) return session.plan;
  std::set<std::string> wanted;
  for (const std::string& name : names) wanted.insert(FindPlannedTrial(session, name).id);
  std::vector<PlannedTrial> found;
  for (const PlannedTrial& planned : session.plan) {
    if (wanted.count(planned.id) > 0) found.push_back(planned);
  }
  return found;
}

/** What is written instead of tables: below the session's export/, which is written again, or to
--out. */
OutputRequest MakeRequest(const RobotExport& options, const std::string& kind) {
  const bool is_own = options.out.empty();
  return {is_own ? options.folder + "/export/" + kind : options.out,
          kind,
          options.replace || is_own,
          {options.folder}};
}

void PrintFiles(const RobotExport& options, const std::string& what,
                const std::vector<std::string>& files) {
  if (options.json) return PrintJson({{"folder", options.folder}, {what, files}});
  PrintResult(fmt::format("{}\n", fmt::join(files, "\n")));
}

/** Which folder is which trial, and how the files belong together. */
std::string FormatMjcfReadme(const std::vector<PlannedTrial>& trials) {
  std::string text =
      "Trials as scenes for MuJoCo 3: scene.xml and its commanded motion, motion.csv. Columns of "
      "motion.csv belong to actuators by name, not by position; the manual's page \"Results\" has "
      "a program that plays a scene.\n\n| folder | hand | object | grasp | condition | trial |\n| "
      "--- | --- | --- | --- | --- | --- |\n";
  for (const PlannedTrial& trial : trials) {
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", trial.id, trial.hand, trial.object,
                        trial.grasp, trial.condition.value_or("base"), trial.trial);
  }
  return text;
}

}  // namespace

void ExportMjcf(const RobotExport& options, const std::vector<std::string>& names,
                const Session& session) {
  const std::vector<PlannedTrial> trials = FindTrials(session, names);
  const SessionInputs inputs = LoadSessionInputs(session.config, FieldUse::kNow, session.folder);
  CheckSameSession(session, session.config, MakePlan(session.config, inputs));
  const OutputRequest request = MakeRequest(options, "mjcf");
  StagedFolder staged(request);
  MjcfExporter exporter;
  std::vector<std::string> scenes;
  for (const PlannedTrial& planned : trials) {
    exporter.Export(ChooseGraspBySight(MakeRecordedSetup(session, inputs, planned)),
                    staged.path() / planned.id);
    scenes.push_back((request.folder / planned.id / "scene.xml").string());
  }
  WriteFile(staged.path() / "README.md", FormatMjcfReadme(trials));
  staged.Commit();
  PrintFiles(options, "scenes", scenes);
}

void ExportUrdf(const RobotExport& options, const Session& session) {
  const SessionInputs inputs = LoadSessionInputs(session.config, FieldUse::kLater, session.folder);
  const OutputRequest request = MakeRequest(options, "urdf");
  StagedFolder staged(request);
  std::vector<std::string> robots;
  for (const SessionHand& hand : inputs.hands) {
    if (!hand.arm) {
      throw Error(ErrorKind::kUsage, "--urdf: the session has no robot arm; the hand alone is " +
                                         hand.hand->folder + "/hand.urdf");
    }
    const std::filesystem::path place = staged.path() / hand.hand->id;
    GatherHand(hand.hand->folder, place);
    WriteFile(place / "robot.urdf",
              FormatArmUrdf(*hand.arm, *hand.hand, ReadFile(place / "hand.urdf")));
    robots.push_back((request.folder / hand.hand->id / "robot.urdf").string());
  }
  staged.Commit();
  PrintFiles(options, "robots", robots);
}

}  // namespace graspbench
