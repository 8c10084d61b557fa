#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include "core/base/text/text.h"
#include "datasets/analysis/judge_evidence.h"
#include "datasets/session/judgement_store.h"
#include "workbench/command.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/run_session.h"
#include "workbench/result_page.h"
#include "workbench/tables/text_table.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {

struct JudgeOptions {
  std::string folder;
  int num_workers = 1;
  OnDamage on_damage = OnDamage::kRefuse;
  double trial_time_limit = kTrialTimeLimit;
  bool json = false;
};

/** One line per hand, object and grasp. */
std::string FormatLoads(const SessionSummary& summary) {
  TextTable table({"hand", "object", "grasp", "judged", "breaking force [N]", "lowest",
                   "breaking moment [N m]", "lowest"});
  for (const CellLoads& loads : ListCellLoads(summary)) {
    const CellSummary& cell = *loads.cell;
    table.AddRow({cell.hand, cell.object, cell.grasp, std::to_string(loads.num_judged),
                  FormatFixed(loads.force.median, 2), FormatFixed(loads.force.lowest, 2),
                  FormatFixed(loads.moment.median, 3), FormatFixed(loads.moment.lowest, 3)});
  }
  return table.Format();
}

void PrintEvidence(const JudgeEvidence& evidence, const Session& session) {
  const auto has_value = [](const RankEvidence& rank) { return bool(rank.correlation); };
  if (std::none_of(evidence.ranks.begin(), evidence.ranks.end(), has_value)) {
    PrintResult(FormatCount(evidence.num_judged, "held grasp") + " judged; medians\n\n" +
                FormatLoads(SummariseSession(session)) +
                (evidence.ranks.empty() ? ""
                                        : "no rank correlation with other measures: " +
                                              FormatCount(evidence.num_cells, "combination") +
                                              " of hand, object and grasp; " +
                                              evidence.ranks.front().correlation.reason() + "\n"));
    return;
  }
  TextTable table({"Measure", "Rank correlation with breaking force", "95 % interval"});
  for (const RankEvidence& rank : evidence.ranks) {
    table.AddRow(
        {rank.measure, rank.correlation ? FormatFixed(rank.correlation->estimate, 3) : "n/a",
         rank.correlation
             ? FormatRange(rank.correlation->interval.low, rank.correlation->interval.high, 3)
             : rank.correlation.reason()});
  }
  PrintResult(FormatCount(evidence.num_judged, "held grasp") + " judged\n\n" + table.Format());
}

/** Names the grasps whose test did not end in time, and those of trials that finished meanwhile.
@param asked  trials whose grasps were to be judged. */
ExitCode TellUnjudged(const Session& session, const std::set<std::string>& asked,
                      const JudgeOptions& options) {
  ExitCode code = kExitOk;
  int num_new = 0;
  for (const PlannedTrial& trial : FindUnjudged(session)) {
    if (asked.count(trial.id) == 0) {
      ++num_new;
      continue;
    }
    code = kExitNumericalFailures;
    PrintMessage("trial " + trial.id + " (" + trial.hand + ", " + trial.object + ", " +
                 trial.grasp + ", number " + std::to_string(trial.trial) +
                 ") is not judged: its test did not end within " +
                 FormatJson(options.trial_time_limit) + " s");
  }
  if (num_new > 0) {
    PrintMessage(FormatCount(num_new, "held grasp", "held grasps") +
                 " of trials that finished in the meantime: not judged yet; to judge: "
                 "graspbench judge " +
                 QuoteForShell(options.folder));
  }
  return code;
}

ExitCode Judge(const JudgeOptions& options) {
  const std::filesystem::path folder = options.folder;
  TerminalObserver observer(
      [&](const Stage& stage) { return options.folder + ": " + DescribeTasks(stage); });
  const JudgeRound round = JudgeSession(folder, options.num_workers, observer, options.on_damage,
                                        options.trial_time_limit);
  DemandFinished(round.is_complete);
  const Session session = LoadSession(folder, options.on_damage, RecordParts::kBrief);
  const std::filesystem::path report = WriteResults(session, MakeKeptTracer(session));
  const JudgeEvidence evidence = CalcJudgeEvidence(session.records);
  if (options.json) {
    PrintJson(ToJson(evidence));
  } else {
    PrintEvidence(evidence, session);
    PrintResult(FormatPlaces(report, folder / "export" / "trials.csv"));
  }
  return TellUnjudged(session, round.asked, options);
}

}  // namespace

void AddJudgeCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "judge",
      "Pull and twist the held objects of a finished session until they leave the hand.",
      "  graspbench judge results/pilot             breaking loads, verdicts, correlations\n  "
      "graspbench judge results/pilot --jobs 1    the same bytes, on one processor");
  const auto options = std::make_shared<JudgeOptions>();
  command.AddRequired("folder", options->folder, "folder of the session", "DIR");
  AddJobsOption(command, options->num_workers, "grasps");
  AddTrialTimeoutOption(command, options->trial_time_limit);
  AddAcceptDamageOption(command, options->on_damage);
  AddJsonOption(command, options->json, "print the correlations as one JSON object");
  command.SetAction([options] { return Judge(*options); });
}

}  // namespace graspbench
