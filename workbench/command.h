#pragma once
/** @file
A command adds itself to the program: its options, and a callback that does the work and leaves the
exit code. Faults are thrown as Error; program.cc prints them and chooses the exit code.

Results go to stdout, messages and progress to stderr. `--json` prints one object. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/optimise/grasp_optimiser.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/plan/session_config.h"
#include "workbench/experiments/session_experiment.h"
#include "workbench/terminal/command_line.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {

#define GRASPBENCH_COMMAND(Name, room) void Add##Name##Command(Command& program);
#include "workbench/commands/command_list.inc"
#undef GRASPBENCH_COMMAND

/** --arm, and --arm-base as a text for ReadArmBase. */
void AddArmOptions(Command& command, ArmConfig& arm, std::string& base);
/** Takes the place of the base from "X,Y,Z,YAW" [m], [deg]. @throws Error(kUsage). */
void ReadArmBase(const std::string& text, ArmConfig& arm);

/** Options that several commands share. */
///@{
/** A list in one word: "--object can,cup"; what it holds is shown as the default. */
void AddListOption(Command& command, const std::string& name, std::vector<std::string>& list,
                   const std::string& text, const std::string& form);
/** "--hand" and "--object", with the configuration's defaults. */
void AddSceneOptions(Command& command, SessionConfig& config);
/** "--set KEY=VALUE", may be repeated. */
void AddSettingsOption(Command& command, std::vector<std::string>& settings,
                       const std::string& example);
/** "--evaluations" and "--fitness-trials". */
void AddSearchOptions(Command& command, OptimiseConfig& config, const std::string& of);
/** "--json": one object instead of lines for a person. */
void AddJsonOption(Command& command, bool& as_json,
                   const std::string& text = "print one JSON object");
/** How a session with a folder of its own is run. */
struct RunOptions {
  std::string out;
  bool resume = false, plan_only = false, json = false;
  OnDamage on_damage = OnDamage::kRefuse;
  double trial_time_limit = kTrialTimeLimit;
  int num_workers = 1;
};
/** "--jobs", "--out", "--resume", "--plan-only", "--accept-damage", "--trial-timeout",
"--allow-remote", "--json".
@param what  "session", "sweep". */
void AddRunOptions(Command& command, RunOptions& options, const std::string& what,
                   const std::string& usual_folder);
/** "--trials" of each hand, object, grasp. @param usual  the default in words. */
void AddTrialsOption(
    Command& command, int& trials, const std::string& usual,
    const std::string& text = "finished trials of each hand, object, grasp to take");
/** "--seed". @param what  another seed gives: "other variations". */
void AddSeedOption(Command& command, int& seed, const std::string& what);
/** "--grasp": one of the files' grasps, by number. */
void AddGraspNumberOption(Command& command, int& number);
/** "--replace": an older result of the command's own kind. */
void AddReplaceOption(Command& command, bool& replace);
/** Before a session is made: rehearses what its grasps ask for and no earlier run has found, with
progress and the time said before. @throws as RehearseTasks. */
void RehearseGrasps(const SessionConfig& config, int num_workers);
/** "--plan-only": for several machines. */
void AddPlanOnlyOption(Command& command, bool& plan_only);
/** Says what was planned and how to go on. */
void PrintPlan(const std::filesystem::path& folder, int count, const std::string& unit,
               bool as_json = false);
/** The same of an experiment: how several machines work on it. */
void PrintExperimentPlan(const PreparedSession& experiment, bool as_json = false);
/** Runs what is left of an experiment on the terminal, or prints its plan where that is all that is
asked for. @returns whether it has run. @throws Error(kInterrupted) as DemandFinished. */
bool RunOrPlan(const PreparedSession& experiment, const ExperimentRequest& request);
/** @throws Error(kInterrupted) saying how to go on, unless it is. */
void DemandFinished(bool is_finished);
/** "--resume": with the settings and the copies of the inputs that are in the folder of --out. */
void AddResumeOption(Command& command, bool& resume);
/** When it was given. @throws Error(kUsage) when one of `settings` was too, or no folder. */
void CheckResume(const Command& command, const std::vector<std::string>& settings);
/** "--accept-damage": go on with what is left of a damaged store. */
void AddAcceptDamageOption(Command& command, OnDamage& on_damage);
/** A number of seconds, finite and above 0; the value is the default. */
void AddSecondsOption(Command& command, const std::string& name, double& seconds,
                      const std::string& text);
/** "--trial-timeout". */
void AddTrialTimeoutOption(Command& command, double& seconds);
/** The folder of a store, the command's argument. "." is replaced by its path, so that what is
advised holds anywhere. */
void AddStoreFolder(Command& command, std::filesystem::path& folder, const std::string& text);
/** "--at", "--camera" and "--size" of a picture (workbench/pictures/trial_picture.h). */
std::vector<Option*> AddPictureOptions(Command& command, std::string& at,
                                       std::vector<std::string>& view, std::string& size);
/** "--jobs": sets num_workers to the number of processors, unless told otherwise. */
void AddJobsOption(Command& command, int& num_workers, const std::string& what = "trials");
///@}

/** "a, b, c", for help texts. */
std::string ListNames(const std::vector<std::string>& names);

}  // namespace graspbench
