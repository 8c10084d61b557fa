#pragma once
/** @file
Each command adds itself to the program: its options, and a callback that does the work and returns
the exit code. Failures are thrown as Error; program.cc prints them and chooses the exit code.

Results go to stdout, messages and progress to stderr. `--json` prints one JSON object. */

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

/** Adds --arm, and --arm-base, whose text ReadArmBase parses. */
void AddArmOptions(Command& command, ArmConfig& arm, std::string& base);
/** Sets the pose of the arm's base from "X,Y,Z,YAW" [m], [deg]. @throws Error(kUsage). */
void ReadArmBase(const std::string& text, ArmConfig& arm);

/** Options that several commands share. */
///@{
/** Adds a comma-separated list option ("--object can,cup"); its current content is shown as the
default. */
void AddListOption(Command& command, const std::string& name, std::vector<std::string>& list,
                   const std::string& text, const std::string& form);
/** Adds "--hand" and "--object", with the defaults of the configuration. */
void AddSceneOptions(Command& command, SessionConfig& config);
/** Adds "--set KEY=VALUE", which may be repeated. */
void AddSettingsOption(Command& command, std::vector<std::string>& settings,
                       const std::string& example);
/** Adds "--evaluations" and "--fitness-trials". */
void AddSearchOptions(Command& command, OptimiseConfig& config, const std::string& of);
/** Adds "--json": one object instead of human-readable text. */
void AddJsonOption(Command& command, bool& as_json,
                   const std::string& text = "print one JSON object");
/** Options for running a session in a folder of its own. */
struct RunOptions {
  std::string out;
  bool resume = false, plan_only = false, json = false;
  OnDamage on_damage = OnDamage::kRefuse;
  double trial_time_limit = kTrialTimeLimit;
  int num_workers = 1;
};
/** Adds "--jobs", "--out", "--resume", "--plan-only", "--accept-damage", "--trial-timeout",
"--allow-remote", "--json".
@param what  what is run: "session", "sweep". */
void AddRunOptions(Command& command, RunOptions& options, const std::string& what,
                   const std::string& usual_folder);
/** Adds "--trials", per hand, object and grasp. @param usual  the default in words. */
void AddTrialsOption(
    Command& command, int& trials, const std::string& usual,
    const std::string& text = "finished trials of each hand, object, grasp to take");
/** Adds "--seed". @param what  what another seed gives: "other variations". */
void AddSeedOption(Command& command, int& seed, const std::string& what);
/** Adds "--grasp": index of one grasp within the files. */
void AddGraspNumberOption(Command& command, int& number);
/** Adds "--replace": overwrite an older result of the same kind. */
void AddReplaceOption(Command& command, bool& replace);
/** Rehearses the hand-object pairs that the session's grasps need and that no earlier run has
rehearsed. To be called before the session is created. Announces the estimated time and shows
progress. @throws as RehearseTasks. */
void RehearseGrasps(const SessionConfig& config, int num_workers);
/** Adds "--plan-only": prepare the folder for several machines and run nothing. */
void AddPlanOnlyOption(Command& command, bool& plan_only);
/** Prints what was planned and the next command to run. */
void PrintPlan(const std::filesystem::path& folder, int count, const std::string& unit,
               bool as_json = false);
/** As PrintPlan, for the trials of an experiment. */
void PrintExperimentPlan(const PreparedSession& experiment, bool as_json = false);
/** Runs the remaining trials of an experiment with progress on the terminal, or prints its plan if
the request is plan-only. @returns whether it was run. @throws Error(kInterrupted) as
DemandFinished. */
bool RunOrPlan(const PreparedSession& experiment, const ExperimentRequest& request);
/** @throws Error(kInterrupted) saying how to continue, unless `is_finished`. */
void DemandFinished(bool is_finished);
/** Adds "--resume": continue with the settings and copied inputs stored in the folder of --out. */
void AddResumeOption(Command& command, bool& resume);
/** Checks the options of a resumed session. @throws Error(kUsage) when one of `settings` or no
--out was given. */
void CheckResume(const Command& command, const std::vector<std::string>& settings);
/** Adds "--accept-damage": use the intact part of a damaged store. */
void AddAcceptDamageOption(Command& command, OnDamage& on_damage);
/** Adds an option in seconds, finite and above 0; the current value is the default. */
void AddSecondsOption(Command& command, const std::string& name, double& seconds,
                      const std::string& text);
/** Adds "--trial-timeout". */
void AddTrialTimeoutOption(Command& command, double& seconds);
/** Adds the store folder as a required argument. "." is replaced by its absolute path, so that
printed commands work from any folder. */
void AddStoreFolder(Command& command, std::filesystem::path& folder, const std::string& text);
/** Adds "--at", "--camera" and "--size" of a picture (workbench/pictures/trial_picture.h). */
std::vector<Option*> AddPictureOptions(Command& command, std::string& at,
                                       std::vector<std::string>& view, std::string& size);
/** Adds "--jobs" and sets num_workers to the number of processors as its default. */
void AddJobsOption(Command& command, int& num_workers, const std::string& what = "trials");
///@}

/** "a, b, c", for help texts. */
std::string ListNames(const std::vector<std::string>& names);

}  // namespace graspbench
