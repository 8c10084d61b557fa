#include <algorithm>
#include <filesystem>
#include <memory>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/session/judgement_store.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/session_experiment.h"
#include "workbench/tables/experiment_tables.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct NumericsOptions {
  ExperimentRequest request;
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
  Observer observer(CatchInterrupts());  // its few trials need no more
  DemandFinished(RunExperiment(experiment, request, observer));
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

void AddCheckNumericsCommand(Command& program) {
  Command& command =
      AddSubcommand(program, "check-numerics",
                    "Repeat trials with other numerical settings and list changed verdicts.",
                    "  graspbench check-numerics results/benchmark-1a2b3c4d\n"
                    "  graspbench check-numerics results/pilot --trials 10 --json");
  const auto options = std::make_shared<NumericsOptions>();
  AddStoreFolder(command, options->request.folder, "folder of the session");
  options->request.trials_per_cell = 1;
  AddTrialsOption(command, options->request.trials_per_cell, "1");
  AddJobsOption(command, options->request.num_workers);
  AddPlanOnlyOption(command, options->request.plan_only);
  command.AddOption("--out", options->out, "table of all comparisons", "FILE")
      ->ShowDefault("check-numerics/numerics.csv in the session");
  AddJsonOption(command, options->json);
  command.SetAction([options] { Check(*options); });
}

}  // namespace graspbench
