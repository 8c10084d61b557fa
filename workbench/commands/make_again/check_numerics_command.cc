#include <algorithm>
#include <filesystem>
#include <memory>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/session/judgement_store.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/session_experiment.h"
#include "workbench/tables/experiment_tables.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct NumericsOptions {
  ExperimentRequest request;
  int num_workers = 1;
  std::string out;
  bool json = false;
};

/** A line for each variant. */
void PrintVariants(const Session& experiment) {
  for (const Condition& variant : experiment.config.conditions) {
    const auto num_trials = std::count_if(
        experiment.plan.begin(), experiment.plan.end(),
        [&](const PlannedTrial& planned) { return planned.condition == variant.name; });
    PrintMessage(variant.name + ": " + FormatCount(num_trials, "trial"));
  }
}

void Check(const NumericsOptions& options) {
  if (!options.out.empty()) CheckOutputFile(options.out);
  const fs::path& folder = options.request.folder;
  ExperimentRequest request = options.request;
  // Without judgements there is no breaking force to compare.
  request.with_judge = std::filesystem::is_directory(folder) && HasBegunJudge(folder);
  const PreparedSession experiment = PrepareExperiment(request, "numerics", ListNumericsVariants);
  if (options.request.plan_only) return PrintExperimentPlan(experiment);
  PrintVariants(experiment.session);
  Observer observer;  // its few trials need no more
  DemandFinished(
      RunExperiment(experiment, request, options.num_workers, observer, CatchInterrupts()));
  const std::vector<NumericsComparison> comparisons = ListNumericsComparisons(
      LoadSession(experiment.folder, options.request.on_damage, RecordParts::kBrief));
  const std::vector<NumericsSummary> summaries = SummariseNumerics(comparisons);
  const fs::path own = folder / "check-numerics";
  const fs::path out = options.out.empty() ? own / "numerics.csv" : fs::path(options.out);
  if (options.out.empty()) UnsealOutput(own);
  if (out.has_parent_path()) MakeFolder(out.parent_path());
  WriteFileAtomically(out, FormatNumericsCsv(comparisons));
  if (options.out.empty()) SealOutput(own, {"numerics.csv"}, {});
  if (options.json) {
    Json json = MakeNumericsJson(summaries, comparisons);
    json["session"] = folder.string();
    json["data"] = out.string();
    PrintJson(json);
  } else {
    PrintResult(FormatNumericsTables(summaries, comparisons) + "\ndata     " + out.string() + "\n");
  }
}

}  // namespace

void AddCheckNumericsCommand(Command& program, ExitCode&) {
  Command& command =
      AddSubcommand(program, "check-numerics",
                    "Run trials again with other numerics and list the verdicts that flip.",
                    "  graspbench check-numerics results/benchmark-1a2b3c4d\n"
                    "  graspbench check-numerics results/pilot --trials 10 --json");
  const auto options = std::make_shared<NumericsOptions>();
  AddStoreFolder(command, options->request.folder, "folder of the session");
  options->request.trials_per_cell = 1;
  command
      .AddOption("--trials", options->request.trials_per_cell,
                 "finished trials of each hand, object, grasp to take")
      ->Within(1, 100000)
      ->ValueName("N")
      ->ShowDefault();
  AddJobsOption(command, options->num_workers);
  AddPlanOnlyOption(command, options->request.plan_only);
  command.AddOption("--out", options->out, "table of all comparisons")
      ->ValueName("FILE")
      ->ShowDefault("check-numerics/numerics.csv in the session");
  command.AddFlag("--json", options->json, "print one JSON object");
  command.SetAction([options] { Check(*options); });
}

}  // namespace graspbench
