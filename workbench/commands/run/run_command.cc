#include <errno.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "core/arm/mounted_arm.h"
#include "core/base/text/text.h"
#include "datasets/analysis/export_result.h"
#include "datasets/analysis/session_summary.h"
#include "datasets/plan/grasp_choice.h"
#include "datasets/plan/grip_check.h"
#include "reports/session_report.h"
#include "workbench/command.h"
#include "workbench/commands/options/session_options.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/pool/worker_pool.h"
#include "workbench/experiments/run_record.h"
#include "workbench/experiments/run_session.h"
#include "workbench/result_page.h"
#include "workbench/tables/summary_table.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct RunCommandOptions {
  SessionOptions session;
  RunOptions run;
};

std::string FormatResumeCommand(const RunCommandOptions& options, const fs::path& folder) {
  return QuoteForShell(program_invocation_name) + " run --resume --out " +
         QuoteForShell(folder.string()) + " --jobs " + std::to_string(options.run.num_workers);
}

void PrintStart(const PreparedSession& work, int num_unfinished, int num_workers) {
  const int num_finished = static_cast<int>(work.session.records.size());
  if (!work.session.findings.entries().empty()) PrintMessage(work.session.findings.Format());
  if (num_finished > 0 && HasRunOfAnotherBuild(work.folder)) {
    PrintMessage(
        "note: some trials of this session were run by another build of graspbench; --out DIR "
        "starts a new session");
  }
  std::string text =
      work.folder.string() + ": " + FormatCount(num_finished + num_unfinished, "trial");
  if (num_unfinished == 0) {
    text += ", all finished before";
  } else {
    text += ", " + std::to_string(num_finished) + " finished before, " +
            std::to_string(num_unfinished) + " to run on " + FormatCount(num_workers, "worker");
  }
  if (!work.inputs.types.empty()) text += "; best grasps: type by rehearsal";
  const ArmConfig& arm = work.session.config.arm;
  if (HasArm(arm)) text += "; arm " + arm.model + ", " + DescribeArmBase(CalcArmBase(arm));
  PrintMessage(text);
}

/** Nothing of the work is needed any more but its folder. */
ExitCode Finish(PreparedSession& work, const RunCommandOptions& options) {
  const fs::path& folder = work.folder;
  const std::vector<Damage> damage = work.session.damage;
  work.session = {};  // before it is loaded again: two large ones would not fit
  work.inputs = {};
  ExplainUnasked(folder, options.run.num_workers, options.run.on_damage);
  Session session = LoadSession(folder, options.run.on_damage, RecordParts::kBrief);
  session.damage = damage;  // what was found before the run sealed what is there
  ExportResult(folder, session);
  const SessionSummary summary = SummariseSession(session);
  const auto wrong =
      std::find_if(session.records.begin(), session.records.end(),
                   [](const auto& r) { return r.result.outcome == Outcome::kWrongAnswer; });
  if (wrong != session.records.end()) {
    PrintMessage("first wrong answer, " + DescribeTrial(wrong->plan) + ": " + wrong->result.reason);
  }
  const TrialTracer trace = MakeKeptTracer(session);
  const fs::path report = WriteSessionReport(folder, std::move(session), trace);
  if (options.run.json) {
    PrintJson(MakeSummaryJson(summary, folder, report));
  } else {
    PrintResult("\n" + FormatSummaryTable(summary) +
                FormatPlaces(report, folder / "export" / "trials.csv") + "next     xdg-open " +
                QuoteForShell(report.string()) + "\n");
  }
  return summary.total.CountOf(Outcome::kNumericalFailure) > 0 ? kExitNumericalFailures : kExitOk;
}

/** For several machines: nothing runs. */
ExitCode Plan(const PreparedSession& work, bool as_json) {
  RecordPlanning(work.folder);
  PrintPlan(work.folder, static_cast<int>(work.session.plan.size()), "trial", as_json);
  return kExitOk;
}

ExitCode Run(const RunCommandOptions& options) {
  SessionRequest request;
  request.name = options.session.name();
  request.out = options.run.out;
  request.resume = options.run.resume;
  request.on_damage = options.run.on_damage;
  if (options.session.HasAny()) {  // what is resumed must agree with what is given, and no more
    const bool goes_on = options.run.resume && HasSession(options.run.out);
    request.config = options.session.MakeConfig(goes_on ? LoadPlannedSession(options.run.out).config
                                                        : options.session.FindBase());
  }
  if (request.config) RehearseGrasps(*request.config, options.run.num_workers);
  PreparedSession work = PrepareSession(request);
  const int num_trials = static_cast<int>(FindUnfinished(work.session).size());
  std::vector<std::string> warnings = ListObjectWarnings(work.config, work.inputs);
  for (auto& warning : ListGripWarnings(work.config, work.inputs)) warnings.push_back(warning);
  for (const std::string& warning : warnings) PrintMessage("warning: " + warning);
  if (options.run.plan_only) return Plan(work, options.run.json);
  const int num_workers = CalcNumWorkers(options.run.num_workers, static_cast<size_t>(num_trials));
  PrintStart(work, num_trials, num_workers);
  if (num_trials == 0) return Finish(work, options);
  TerminalObserver observer;
  RunRecord record;
  try {
    record = RunRound(kTrialRound, work, num_workers, observer, options.run.trial_time_limit);
    if (record.ending == RunEnding::kFinished) return Finish(work, options);
  } catch (const Error& error) {
    throw Error(error.kind(), std::string(error.what()) +
                                  "\nFinished trials are kept. Continue with\n  " +
                                  FormatResumeCommand(options, work.folder));
  }
  throw Error(ErrorKind::kInterrupted,
              "stopped; " + std::to_string(num_trials - record.num_trials) +
                  " trials are left; finished trials are kept. Continue with\n  " +
                  FormatResumeCommand(options, work.folder));
}

}  // namespace

void AddRunCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "run", "Run a benchmark session and write its report.",
      "  graspbench run                       both hands, 21 objects, 10 trials each\n"
      "  graspbench run --hand shadow --object can,cup --grasp all --trials 3");
  const auto options = std::make_shared<RunCommandOptions>();
  options->session.AddTo(command);
  options->session.AddBenchmarkTo(command);
  AddRunOptions(command, options->run, "session", "results/NAME-HASH");
  command.SetAction([options] { return Run(*options); });
}

}  // namespace graspbench
