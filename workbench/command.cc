#include "workbench/command.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "core/arm/arm_config.h"
#include "core/base/enum_table.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/policies/websocket_policy.h"
#include "workbench/experiments/rehearse_objects.h"
#include "workbench/experiments/run_record.h"
#include "workbench/experiments/session_experiment.h"
#include "workbench/pictures/scene_view.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {

/** Adds the names of "g1,g2". @throws Error(kUsage) where one is empty. */
void SplitNames(const std::string& option, const std::string& given,
                std::vector<std::string>& names) {
  size_t number = 1;
  for (size_t start = 0; start <= given.size(); ++number) {
    const size_t comma = std::min(given.find(',', start), given.size());
    if (comma == start) {
      throw Error(ErrorKind::kUsage,
                  option + " \"" + given + "\": name " + std::to_string(number) +
                      " of the list is empty; expected names separated by single commas");
    }
    names.push_back(given.substr(start, comma - start));
    start = comma + 1;
  }
}

}  // namespace

void AddListOption(Command& command, const std::string& name, std::vector<std::string>& list,
                   const std::string& text, const std::string& form) {
  std::string names;
  for (const std::string& item : list) names += (names.empty() ? "" : ",") + item;
  // Not by SplitAtCommas(), which drops empty names.
  command
      .AddOptionFunction<std::vector<std::string>>(
          name,
          [name, &list](const std::vector<std::string>& given) {
            list.clear();
            for (const std::string& one : given) SplitNames(name, one, list);
          },
          text, form)
      ->OneValueEach()
      ->ShowDefault(names);
}

void AddSceneOptions(Command& command, SessionConfig& config) {
  AddListOption(command, "--hand", config.hands, "hands by id or folder, or all", "H,..");
  AddListOption(command, "--object", config.objects,
                "objects by id or folder, all, or a folder of such folders", "O,..");
}

void AddSettingsOption(Command& command, std::vector<std::string>& settings,
                       const std::string& example) {
  command.AddOption("--set", settings, "any other setting, e.g. " + example, "KEY=VALUE")
      ->OneValueEach();
}

void AddSearchOptions(Command& command, OptimiseConfig& config, const std::string& of) {
  command.AddOption("--evaluations", config.evaluations, of, "N")->ShowDefault();
  command
      .AddOption("--fitness-trials", config.fitness_trials,
                 "trials per evaluation: 1 is without variation, more are sampled", "N")
      ->ShowDefault();
  command
      .AddOption("--search", config.search, "what step 2 changes: " + ListNames(ListGraspSpaces()),
                 "SPACE")
      ->OneOf(ListGraspSpaces())
      ->ShowDefault();
  command.AddFlag("--race", config.race,
                  "simulate only the 28 % of individuals that earlier results rank highest");
  command
      .AddOption("--fitness", config.fitness,
                 "objective of step 2: sigma (statics) or strength (simulated pulls)", "FITNESS")
      ->OneOf(ListNames(kFitnessKinds))
      ->ShowDefault();
  command
      .AddOption("--grip", config.grip,
                 "grip force allowed to a new target: equal (to the start), free, or limit", "GRIP")
      ->OneOf(ListNames(kGripBudgets))
      ->ShowDefault();
  command.AddOption("--grip-limit", config.grip_limit, "for --grip limit [N]", "N");
}

void AddReplaceOption(Command& command, bool& replace) {
  command.AddFlag("--replace", replace, "replace an earlier result if all its files are unchanged");
}

void AddPlanOnlyOption(Command& command, bool& plan_only) {
  command.AddFlag("--plan-only", plan_only, "prepare the folder and run nothing; see work, submit");
}

void AddArmOptions(Command& command, ArmConfig& arm, std::string& base) {
  command.AddOption("--arm", arm.model,
                    "arm that carries the hand, by id or folder: puma560, pa10; none: no arm",
                    "ARM");
  command.AddOption("--arm-base", base,
                    "position of the arm's base [m] and its rotation about the vertical [deg]; the "
                    "object is at 0,0,0",
                    "X,Y,Z,YAW");
}

void ReadArmBase(const std::string& text, ArmConfig& arm) {
  std::vector<double> numbers;
  bool are_numbers = true;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    are_numbers = ReadNumber(word, numbers.emplace_back()) && are_numbers;
  }
  if (!are_numbers || numbers.size() != 4) {
    throw Error(ErrorKind::kUsage,
                "--arm-base " + text +
                    ": expected four numbers X,Y,Z,YAW in m and degrees, for example -0.5,0,0,0");
  }
  arm.x = numbers[0];
  arm.y = numbers[1];
  arm.z = numbers[2];
  arm.yaw = std::remainder(RadFromDeg(numbers[3]), 2.0 * kPi);
}

void RehearseGrasps(const SessionConfig& config, int num_workers) {
  const std::vector<RehearsalTask> tasks = ListUnrehearsed(config);
  if (tasks.empty()) return;
  TerminalObserver observer(DescribeTasks);
  int num_candidates = 0;
  for (const RehearsalTask& task : tasks) num_candidates += task.config.num_candidates;
  PrintMessage("grasps of " + FormatCount(static_cast<int>(tasks.size()), "pair") +
               " of hand and object are rehearsed first: at most " +
               FormatCount(num_candidates, "candidate") + ", about " +
               FormatFixed(EstimateRehearsalTime(tasks).candidates, 0) +
               " s of one processor, estimated from the first pair of each hand");
  RehearseTasks(tasks, num_workers, observer);
}

void PrintPlan(const std::filesystem::path& folder, int count, const std::string& unit,
               bool as_json) {
  const std::string name = folder.string();
  const std::string next = "graspbench submit " + QuoteForShell(name) + " --engine local";
  if (as_json) {
    PrintJson({{"folder", name}, {unit + "s", count}, {"next", next}});
  } else {
    PrintResult(name + ": " + FormatCount(count, unit) + " planned\nnext     " + next + "\n");
  }
}

void PrintExperimentPlan(const PreparedSession& experiment, bool as_json) {
  PrintPlan(experiment.folder, static_cast<int>(experiment.session.plan.size()), "trial", as_json);
}

bool RunOrPlan(const PreparedSession& experiment, const ExperimentRequest& request) {
  if (request.plan_only) {
    PrintExperimentPlan(experiment);
    return false;
  }
  TerminalObserver observer(DescribeTasks);
  DemandFinished(RunExperiment(experiment, request, observer));
  return true;
}

void DemandFinished(bool is_finished) {
  if (is_finished) return;
  throw Error(ErrorKind::kInterrupted,
              "stopped; finished trials are kept. Repeat the command to continue");
}

void AddJsonOption(Command& command, bool& as_json, const std::string& text) {
  command.AddFlag("--json", as_json, text);
}

void AddResumeOption(Command& command, bool& resume) {
  command.AddFlag("--resume", resume,
                  "continue the session in the folder of --out with its stored settings");
}

void CheckResume(const Command& command, const std::vector<std::string>& settings) {
  if (!command.IsGiven("--out")) {
    throw Error(ErrorKind::kUsage, "--resume needs --out DIR, the folder to be continued");
  }
  for (const std::string& name : settings) {
    if (!command.IsGiven(name)) continue;
    throw Error(ErrorKind::kUsage, name +
                                       " cannot be combined with --resume: a continued session "
                                       "keeps its settings; leave it out");
  }
}

void AddRunOptions(Command& command, RunOptions& options, const std::string& what,
                   const std::string& usual_folder) {
  AddJobsOption(command, options.num_workers);
  command.AddOption("--out", options.out, "folder of the " + what, "DIR")
      ->ShowDefault(usual_folder);
  command.AddFlag("--resume", options.resume, "continue the " + what + " in the folder of --out");
  AddPlanOnlyOption(command, options.plan_only);
  AddAcceptDamageOption(command, options.on_damage);
  AddTrialTimeoutOption(command, options.trial_time_limit);
  command.AddFlag(
      "--allow-remote", [] { AllowRemotePolicies(); },
      "allow a policy server on another machine, which then receives the observations");
  AddJsonOption(command, options.json, "print the summary as one JSON object");
}

void AddTrialsOption(Command& command, int& trials, const std::string& usual,
                     const std::string& text) {
  command.AddOption("--trials", trials, text, "N")->Within(1, 100000)->ShowDefault(usual);
}

void AddSeedOption(Command& command, int& seed, const std::string& what) {
  command.AddOption("--seed", seed, "another seed gives " + what, "N")->ShowDefault();
}

void AddGraspNumberOption(Command& command, int& number) {
  command.AddOption("--grasp", number, "index of the grasp within the files, from 0", "N")
      ->Within(0, 100000000)
      ->ShowDefault();
}

void AddAcceptDamageOption(Command& command, OnDamage& on_damage) {
  command.AddFlag(
      "--accept-damage", [&on_damage] { on_damage = OnDamage::kAccept; },
      "use the intact part of a damaged folder; the report names the damage");
}

void AddSecondsOption(Command& command, const std::string& name, double& seconds,
                      const std::string& text) {
  const auto check = [](const std::string& value) {
    double number = 0.0;
    const bool is_time = ReadNumber(value, number) && std::isfinite(number) && number > 0.0;
    return is_time ? std::string() : "\"" + value + "\": expected a number of seconds above 0";
  };
  command.AddOption(name, seconds, text, "S")->Check(check)->ShowDefault();
}

void AddTrialTimeoutOption(Command& command, double& seconds) {
  AddSecondsOption(
      command, "--trial-timeout", seconds,
      "seconds of processor time after which a trial is given up as a numerical failure");
}

void AddStoreFolder(Command& command, std::filesystem::path& folder, const std::string& text) {
  const auto name = [](const std::string& value) {
    return value == "." ? std::filesystem::current_path().string() : value;
  };
  command.AddRequired("folder", folder, text, "DIR")->Transform(name);
}

std::vector<Option*> AddPictureOptions(Command& command, std::string& at,
                                       std::vector<std::string>& view, std::string& size) {
  return {command.AddOption(
              "--at,--phase", at,
              "instant: a time such as 1.25s, or the end of a phase (default: stabilisation)",
              "TIME|PHASE"),
          command
              .AddOption("--camera", view, "from where: " + ListNames(ListSceneViews()),
                         "VIEW [AZ EL [ZOOM]]")
              ->NumValues(1, 4),
          command.AddOption("--size", size, "of the picture, in pixels", "WxH")->ShowDefault()};
}

void AddJobsOption(Command& command, int& num_workers, const std::string& what) {
  num_workers = CountProcessors();
  command.AddOption("--jobs", num_workers, what + " at a time", "N")
      ->Within(1, 1024)
      ->ShowDefault("processors");
}

std::string ListNames(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace graspbench
