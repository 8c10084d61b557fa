#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "core/base/config.h"
#include "core/base/files.h"
#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/grasp/grasp_file.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/scene_runner.h"
#include "workbench/plain_text.h"
#include "workbench/progress.h"
#include "workbench/text_table.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct OptimiseOptions {
  SceneConfig config;
  std::optional<int> replay;
  int num_workers = 1;
  std::string out;
};

void CheckConfig(const OptimiseConfig& config) {
  std::string text;
  for (const ConfigProblem& problem : Validate(config)) {
    text += "\n" + problem.key + ": " + problem.text;
  }
  if (!text.empty()) throw Error(ErrorKind::kRange, "the optimisation cannot be run" + text);
}

/** Without --out the folder is named by its configuration: the same command continues it. */
fs::path FindFolder(const OptimiseOptions& options, const SceneInputs& inputs) {
  if (!options.out.empty()) return options.out;
  const std::string hash = CalcHashHex(FormatJson(ConfigToJson(options.config))).substr(0, 8);
  return fs::path("results") /
         ("optimise-" + inputs.hand->id + "-" + inputs.object->id + "-" + hash);
}

std::string FormatAngles(const Hand& hand, const StandardGrasp& grasp, const Eigen::VectorXd& q) {
  const Digit& digit = hand.digits[static_cast<size_t>(FindOpposingDigit(hand, grasp))];
  std::string text;
  for (const int joint : FindDrivenJoints(hand, digit)) {
    text += (text.empty() ? "" : " ") + FormatFixed(DegFromRad(q[joint]), 1);
  }
  return MakePlainText(text);
}

void AddDecision(const std::string& step, const std::vector<LearningTrial>& before,
                 const std::vector<LearningTrial>& after, TextTable& table) {
  const auto add_row = [&](const std::string& when, const std::vector<LearningTrial>& trials) {
    if (trials.empty()) return;
    const double median = CalcMedianGftRatio(trials);
    table.AddRow({step, when,
                  std::to_string(CountSuccesses(trials)) + " of " + std::to_string(trials.size()),
                  FormatFixed(CalcMeanSigma(trials), 3),
                  std::isfinite(median) ? FormatFixed(100.0 * median, 1) : "n/a"});
  };
  add_row("before", before);
  add_row("after", after);
}

void PrintSummary(const SceneInputs& inputs, const SceneConfig& config,
                  const OptimisedGrasp& result, const fs::path& folder) {
  const Hand& hand = *inputs.hand;
  const PreGraspStep& step1 = result.pregrasp_step;
  const TargetStep& step2 = result.target_step;
  TextTable decisions({"check trials", "", "success", "mean sigma", "median GFT%"});
  TextTable angles(
      {hand.digits[static_cast<size_t>(FindOpposingDigit(hand, inputs.grasp))].name + " [deg]",
       "pre-grasp", "target"});
  const auto add_angles = [&](const std::string& variant, const StandardGrasp& grasp) {
    angles.AddRow({variant, FormatAngles(hand, grasp, grasp.q_pre),
                   FormatAngles(hand, grasp, grasp.q_target)});
  };
  std::cout << '\n';
  add_angles("standard grasp", inputs.grasp);
  if (config.optimise.step != "2") {
    std::cout << "step 1   " << step1.verdict << '\n';
    AddDecision("step 1", step1.standard_trials,
                step1.shots.empty()
                    ? std::vector<LearningTrial>()
                    : step1.shots[static_cast<size_t>(std::max(step1.chosen, 0))].trials,
                decisions);
    add_angles("new pre-grasp", result.new_pregrasp);
  }
  if (config.optimise.step != "1") {
    const SearchResult& search = step2.search;
    std::cout << "step 2   " << step2.verdict << "; fitness "
              << FormatFixed(search.individuals.front().fitness, 3) << " -> "
              << FormatFixed(search.individuals[static_cast<size_t>(search.best)].fitness, 3)
              << " in " << FormatCount(static_cast<int>(search.individuals.size()), "evaluation")
              << "; found number " << step2.found << '\n';
    AddDecision("step 2", step2.check_before, step2.check_after, decisions);
    add_angles("new target grasp", result.new_target);
  }
  std::cout << '\n' << decisions.Format() << '\n' << angles.Format() << '\n';
  for (const char* variant : {"new-pregrasp", "new-target"}) {
    const fs::path path = folder / (std::string(variant) + ".yaml");
    if (fs::exists(path)) std::cout << "grasp    " << path.string() << '\n';
  }
  std::cout << "data     " << (folder / "result.json").string() << '\n';
}

void Optimise(OptimiseOptions options) {
  SceneConfig& config = options.config;
  if (config.hand.empty() || config.object.empty()) {
    throw Error(ErrorKind::kUsage,
                "--hand and --object say what to optimise\nsee: graspbench "
                "optimise --help");
  }
  CheckConfig(config.optimise);
  const SceneInputs inputs = LoadSceneInputs(config);
  const fs::path folder = FindFolder(options, inputs);
  const int num_planned = CountLearningTrials(config.optimise);
  std::cerr << folder.string() << ": " << inputs.hand->id << ", " << inputs.object->id << ", "
            << config.grasp << "; at most " << FormatCount(num_planned, "trial") << " on "
            << FormatCount(options.num_workers, "worker") << '\n';

  const std::atomic<bool>& stop = CatchInterrupts();
  TrialPool pool(options.num_workers, stop);
  Progress progress(stderr, num_planned, {});
  const auto start = std::chrono::steady_clock::now();
  BatchStatus status;
  PlannedTrial current;
  const auto observe = [&](const LearningRequest& request, const LearningTrial& trial) {
    ++status.num_done;
    ++status.outcomes[trial.outcome];
    current = {"", inputs.hand->id, inputs.object->id, config.grasp + "  " + request.stage,
               request.individual.number};
    status.busy = {&current};
    progress.Show(status,
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  };
  try {
    const OptimisedGrasp result = RunScene(folder, config, inputs, pool, observe);
    progress.SetPlanned(status.num_done);
    progress.Finish();
    PrintSummary(inputs, config, result, folder);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInterrupted) throw;
    throw Error(ErrorKind::kInterrupted,
                "stopped; finished evaluations are kept, the same command with --out " +
                    folder.string() + " continues");
  }
}

/** Simulates one individual of a finished search again and saves its grasp. */
ExitCode Replay(const OptimiseOptions& options) {
  if (options.out.empty()) throw Error(ErrorKind::kUsage, "--replay needs the folder, --out DIR");
  TrialPool pool(options.num_workers, CatchInterrupts());
  const ReplayedIndividual replayed = ReplayIndividual(options.out, *options.replay, pool);
  SceneConfig config = LoadScene(options.out).config;
  const SceneInputs inputs = LoadSceneInputs(config);
  const fs::path path = fs::path(options.out) / (replayed.grasp.id + ".yaml");
  WriteFileAtomically(path, FormatGraspFile(*inputs.hand, replayed.grasp, config.grasp));
  std::cout << replayed.grasp.id << ": fitness " << FormatFixed(replayed.stored_fitness, 6)
            << " stored, " << FormatFixed(replayed.fitness, 6) << " now; "
            << (replayed.is_same ? "every number is the same" : "not the same numbers")
            << "\ngrasp    " << path.string() << '\n';
  return replayed.is_same ? kExitOk : kExitFailed;
}

}  // namespace

void AddOptimiseCommand(CLI::App& program, ExitCode& exit_code) {
  CLI::App& command =
      AddSubcommand(program, "optimise", "Makes a standard grasp fit one object, in two steps.",
                    "  graspbench optimise --hand tum --object adhesive_tape --out results/tape\n"
                    "  graspbench run --hand tum --object adhesive_tape --grasp "
                    "best,results/tape/new-target.yaml");
  const auto options = std::make_shared<OptimiseOptions>();
  options->config.grasp = "best";
  OptimiseConfig& config = options->config.optimise;
  command.add_option("--hand", options->config.hand, "hand by id or folder")->option_text("H");
  command.add_option("--object", options->config.object, "object by id or folder")
      ->option_text("O");
  command.add_option("--grasp", options->config.grasp, "standard grasp (default best)")
      ->option_text("G");
  command
      .add_option("--step", config.step, "1: new pre-grasp, 2: new target grasp, both (default)")
      ->check(CLI::IsMember({"1", "2", "both"}))
      ->option_text("STEP");
  command
      .add_option("--method", config.method,
                  "search of step 2: es (default), cmaes, de, random, grid")
      ->check(CLI::IsMember(ListSearchMethods()))
      ->option_text("METHOD");
  command.add_option("--evaluations", config.evaluations, "of step 2 (default 1000)")
      ->option_text("N");
  command
      .add_option("--fitness-trials", config.fitness_trials,
                  "trials of an evaluation: 1 without variation, or so many drawn ones (default " +
                      std::to_string(config.fitness_trials) + ")")
      ->option_text("N");
  command.add_option("--seed", config.seed, "another seed gives another search (default 1)")
      ->option_text("N");
  AddJobsOption(command, options->num_workers);
  command
      .add_option("--out", options->out,
                  "folder of the results; the same command again continues it")
      ->option_text("DIR");
  command
      .add_option("--replay", options->replay,
                  "simulate individual N of the finished folder again and save its grasp")
      ->option_text("N");
  command.callback([options, &exit_code] {
    if (options->replay) {
      exit_code = Replay(*options);
    } else {
      Optimise(*options);
    }
  });
}

}  // namespace graspbench
