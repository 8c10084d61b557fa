#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/config.h"
#include "core/base/text/text.h"
#include "workbench/command.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/run_record.h"
#include "workbench/experiments/scene_runner.h"
#include "workbench/tables/optimise_tables.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

struct OptimiseOptions {
  SceneConfig config;
  std::vector<std::string> settings;
  std::optional<int> replay;
  int num_workers = 1;
  double trial_time_limit = kTrialTimeLimit;
  fs::path out;
  bool resume = false, plan_only = false, json = false;
};

ExitCode Finish(const fs::path& folder, const SceneInputs& inputs, const OptimiseOptions& options,
                const OptimisedGrasp& result) {
  const std::string text = FormatOptimisation(inputs, options.config, result);
  options.json ? PrintJson(MakeSceneJson(folder))
               : PrintResult(text + "\n" + ListSceneFiles(folder));
  const std::string failures = DescribeNumericalFailures(LoadScene(folder).evaluations);
  if (!failures.empty()) PrintMessage(failures);
  return failures.empty() ? kExitOk : kExitNumericalFailures;
}

/** "100 trials of the search and up to 548 to choose and check: at most 648 trials". */
std::string DescribeTrials(OptimiseConfig config, int most) {
  config.evaluations = 0;
  const int rest = CountLearningTrials(config);
  return (most == rest ? ""
                       : FormatCount(most - rest, "trial") + " of the search and up to " +
                             std::to_string(rest) + " to choose and check: ") +
         "at most " + FormatCount(most, "trial");
}

ExitCode Optimise(OptimiseOptions options) {
  SceneConfig& config = options.config;
  if (options.resume) config = LoadScene(options.out).config;
  if (config.hand.empty() || config.object.empty()) {
    throw Error(ErrorKind::kUsage,
                "--hand and --object are required\nsee: graspbench optimise --help");
  }
  for (const std::string& setting : options.settings) {
    SetConfigValue(setting, static_cast<TrialConditions&>(config));
  }
  CheckOptimiseConfig(config.optimise);
  const SceneInputs inputs = LoadSceneInputs(config, options.resume ? options.out : fs::path());
  const fs::path folder = options.out.empty() ? NameSceneFolder(config, inputs) : options.out;
  if (options.plan_only) {
    PlanScene(folder, config);
    RecordPlanning(folder);
    PrintPlan(folder, 1, "scene", options.json);
    return kExitOk;
  }
  TerminalObserver observer([&](const Stage& stage) {
    return folder.string() + ": " + inputs.hand->id + ", " + inputs.object->id + ", " +
           config.grasp + "; " + DescribeTrials(config.optimise, stage.num_trials) + " on " +
           FormatCount(options.num_workers, "worker");
  });
  try {
    return Finish(folder, inputs, options,
                  RunSceneStage(folder, config, inputs, options.num_workers, observer,
                                options.trial_time_limit));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInterrupted) throw;
    throw Error(ErrorKind::kInterrupted,
                "stopped; finished evaluations are kept. Continue with\n  graspbench optimise "
                "--resume --out " +
                    QuoteForShell(folder.string()));
  }
}

ExitCode Replay(const OptimiseOptions& options) {
  if (options.out.empty())
    throw Error(ErrorKind::kUsage, "--replay needs --out DIR, the folder of the optimisation");
  TrialPool pool(options.num_workers, CatchInterrupts());
  const ReplayedIndividual replayed = ReplayIndividual(options.out, *options.replay, pool);
  PrintResult(FormatReplay(replayed) + "grasp    " + SaveReplayed(options.out, replayed).string() +
              "\n");
  return replayed.is_same ? kExitOk : kExitFailed;
}

void AddOptions(Command& command, OptimiseOptions& options) {
  SceneConfig& scene = options.config;
  OptimiseConfig& config = scene.optimise;
  scene.grasp = "best";
  command.AddOption("--hand", scene.hand, "hand by id or folder", "H");
  command.AddOption("--object", scene.object, "object by id or folder", "O");
  command.AddOption("--grasp", scene.grasp, "standard grasp", "G")->ShowDefault();
  command.AddOption("--step", config.step, "1: new pre-grasp, 2: new target grasp, both", "STEP")
      ->OneOf(ListNames(kOptimiseSteps))
      ->ShowDefault();
  command
      .AddOption("--method", config.method,
                 "search method of step 2: " + ListNames(ListSearchMethods()), "METHOD")
      ->OneOf(ListSearchMethods())
      ->ShowDefault();
  AddSearchOptions(command, config, "of step 2");
  AddSeedOption(command, config.seed, "another search");
  AddSettingsOption(command, options.settings, "model.mass_scale=2");
  AddPlanOnlyOption(command, options.plan_only);
  AddJobsOption(command, options.num_workers);
  command
      .AddOption("--out", options.out, "folder for the results; repeat the command to continue",
                 "DIR")
      ->ShowDefault("results/optimise-HAND-OBJECT-HASH");
  AddResumeOption(command, options.resume);
  AddTrialTimeoutOption(command, options.trial_time_limit);
  AddJsonOption(command, options.json);
  command.AddOption("--replay", options.replay,
                    "simulate individual N of a finished optimisation again and save its grasp",
                    "N");
}

}  // namespace

void AddOptimiseCommand(Command& program) {
  Command& command =
      AddSubcommand(program, "optimise", "Optimise a standard grasp for one object in two steps.",
                    "  graspbench optimise --hand tum --object adhesive_tape --out results/tape\n"
                    "  graspbench run --hand tum --object adhesive_tape --grasp "
                    "best,results/tape/new-target.yaml");
  const auto options = std::make_shared<OptimiseOptions>();
  AddOptions(command, *options);
  command.SetAction([options, &command] {
    if (options->resume) {
      CheckResume(command, {"--hand", "--object", "--grasp", "--step", "--method", "--evaluations",
                            "--fitness-trials", "--search", "--fitness", "--race", "--grip",
                            "--grip-limit", "--seed", "--set", "--plan-only", "--replay"});
    }
    return options->replay ? Replay(*options) : Optimise(*options);
  });
}

}  // namespace graspbench
