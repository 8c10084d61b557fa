#include <algorithm>
#include <filesystem>
#include <memory>

#include "core/base/files/files.h"
#include "core/base/text/range_text.h"
#include "core/base/text/text.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/session/judgement_store.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/session_experiment.h"
#include "workbench/tables/experiment_tables.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

/** "0.4 (12)": median and largest [%]. */
std::string FormatChange(const ChangeSummary& change) {
  if (change.num == 0) return "n/a";
  return FormatSignificant(100.0 * change.median, 2) + " (" +
         FormatSignificant(100.0 * change.max, 2) + ")";
}

std::string FormatChanges(const std::vector<NumericsSummary>& summaries) {
  std::vector<std::string> head = {"change [%] in", "seat", "held"};
  for (const NumericsMeasure& measure : ListNumericsMeasures()) head.emplace_back(measure.title);
  TextTable table(head);
  for (const NumericsSummary& summary : summaries) {
    for (const SeatNumerics& seat : summary.seats) {
      std::vector<std::string> row = {summary.variant,
                                      seat.seat == Seat::kUnknown ? "n/a" : NameOf(seat.seat),
                                      std::to_string(seat.num_held)};
      for (const ChangeSummary& change : seat.changes) row.push_back(FormatChange(change));
      table.AddRow(row);
    }
  }
  return table.Format();
}

}  // namespace

std::string FormatNumericsTables(const std::vector<NumericsSummary>& summaries,
                                 const std::vector<NumericsComparison>& comparisons) {
  TextTable table({"variant", "trials", "held before", "held now", "flips", "seat flips", "flagged",
                   "others above 10 %"});
  int num_flips = 0, num_failures = 0;
  bool leaves_out = false;
  for (const NumericsSummary& summary : summaries) {
    leaves_out = leaves_out || summary.num_left_out > 0;
    table.AddRow({summary.variant,
                  FormatCountOf(summary.num_trials, summary.num_trials + summary.num_left_out),
                  std::to_string(summary.num_successes_before),
                  std::to_string(summary.num_successes), std::to_string(summary.num_flips),
                  std::to_string(summary.num_seat_flips), std::to_string(summary.num_flagged),
                  std::to_string(summary.num_large)});
    num_flips += summary.num_flips;
    num_failures += summary.num_numerical_failures;
  }
  std::string text = table.Format() +
                     (leaves_out ? "n of N trials: the others are not finished, or the variant's "
                                   "backend cannot move them\n"
                                 : "") +
                     "flagged: held, but reseated or caged; above 10 %: grip, sigma or breaking "
                     "force of the other held\n\n" +
                     FormatChanges(summaries) + "median (largest) of each seat\n";
  if (num_failures > 0) text += FormatCount(num_failures, "numerical failure") + '\n';
  if (num_flips == 0) return text + "\nno verdict flips\n";

  TextTable flips({"flips in", "hand", "object", "grasp", "trial", "before", "after"});
  for (const NumericsComparison& comparison : comparisons) {
    if (!comparison.is_flipped()) continue;
    const PlannedTrial& plan = comparison.before.plan;
    flips.AddRow({comparison.variant, plan.hand, plan.object, plan.grasp,
                  std::to_string(plan.trial), NameOf(comparison.before.result.outcome),
                  NameOf(comparison.after.result.outcome)});
  }
  return text + '\n' + flips.Format();
}

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
