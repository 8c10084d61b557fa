#include <filesystem>
#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "datasets/analysis/judge_evidence.h"
#include "datasets/session/judgement_store.h"
#include "workbench/command.h"
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

void PrintEvidence(const JudgeEvidence& evidence) {
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

/** Names the grasps whose test did not end in time. */
ExitCode TellUnjudged(const Session& session, double trial_time_limit) {
  const std::vector<PlannedTrial> unjudged = FindUnjudged(session);
  for (const PlannedTrial& trial : unjudged) {
    PrintMessage("trial " + trial.id + " (" + trial.hand + ", " + trial.object + ", " +
                 trial.grasp + ", number " + std::to_string(trial.trial) +
                 ") stays unjudged: the judge had not ended after " + FormatJson(trial_time_limit) +
                 " s");
  }
  return unjudged.empty() ? kExitOk : kExitNumericalFailures;
}

ExitCode Judge(const JudgeOptions& options) {
  const std::filesystem::path folder = options.folder;
  TerminalObserver observer(
      [&](const Stage& stage) { return options.folder + ": " + DescribeTasks(stage); });
  if (!JudgeSession(folder, options.num_workers, observer, options.on_damage,
                    options.trial_time_limit)) {
    throw Error(ErrorKind::kInterrupted,
                "stopped; what was judged is kept. Continue with the same command");
  }
  const Session session = LoadSession(folder, options.on_damage, RecordParts::kBrief);
  const std::filesystem::path report = WriteResults(session, MakeKeptTracer(session));
  const JudgeEvidence evidence = CalcJudgeEvidence(session.records);
  if (options.json) {
    PrintJson(ToJson(evidence));
  } else {
    PrintEvidence(evidence);
    PrintResult(FormatPlaces(report, folder / "export" / "trials.csv"));
  }
  return TellUnjudged(session, options.trial_time_limit);
}

}  // namespace

void AddJudgeCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "judge",
      "Pull and twist the held objects of a finished session until they leave the hand.",
      "  graspbench judge results/pilot             breaking loads, verdicts, evidence\n"
      "  graspbench judge results/pilot --jobs 1    the same bytes, on one processor");
  const auto options = std::make_shared<JudgeOptions>();
  command.AddRequired("folder", options->folder, "folder of the session", "DIR");
  AddJobsOption(command, options->num_workers, "grasps");
  AddTrialTimeoutOption(command, options->trial_time_limit);
  AddAcceptDamageOption(command, options->on_damage);
  AddJsonOption(command, options->json, "print the evidence as one JSON object");
  command.SetAction([options] { return Judge(*options); });
}

}  // namespace graspbench
