#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>

#include "core/base/text.h"
#include "datasets/analysis/judge_evidence.h"
#include "datasets/session/judgement_store.h"
#include "reports/session_report.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/session_worker.h"
#include "workbench/progress.h"
#include "workbench/text_table.h"

namespace graspbench {
namespace {

struct JudgeOptions {
  std::string folder;
  int num_workers = 1;
  bool json = false;
};

void JudgeTrials(const JudgeOptions& options, const Session& session) {
  const SessionInputs inputs = LoadSessionInputs(session.config);
  CheckSameSession(session, session.config, MakePlan(session.config, inputs));
  const std::vector<PlannedTrial> trials = FindUnjudged(session);
  const int num_trials = static_cast<int>(trials.size());
  std::cerr << options.folder << ": " << FormatCount(num_trials, "held grasp") << " to judge\n";
  if (trials.empty()) return;

  Progress progress(stderr, num_trials, {});
  const std::atomic<bool>& stop = CatchInterrupts();
  const auto start = std::chrono::steady_clock::now();
  const auto show = [&](const BatchStatus& status) {
    progress.Show(status,
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  };
  const bool is_complete = RunBatch(trials, std::min(options.num_workers, num_trials),
                                    MakeJudgeWorkers(session, inputs, options.folder), show, stop);
  progress.Finish();
  if (!is_complete) {
    throw Error(ErrorKind::kInterrupted,
                "stopped; what was judged is kept. Continue with the same command");
  }
}

void PrintEvidence(const JudgeEvidence& evidence) {
  std::cout << FormatCount(evidence.num_judged, "held grasp") << " judged\n\n";
  TextTable table({"Measure", "Rank correlation with breaking force", "95 % interval"});
  for (const RankEvidence& rank : evidence.ranks) {
    table.AddRow({rank.measure,
                  rank.correlation ? FormatFixed(rank.correlation->estimate, 3) : "n/a",
                  rank.correlation ? FormatFixed(rank.correlation->interval.low, 3) + " to " +
                                         FormatFixed(rank.correlation->interval.high, 3)
                                   : rank.correlation.reason()});
  }
  std::cout << table.Format();
}

}  // namespace

void AddJudgeCommand(CLI::App& program, ExitCode&) {
  CLI::App& command = AddSubcommand(
      program, "judge",
      "Pulls and twists the held objects of a finished session until they leave the hand.",
      "  graspbench judge results/pilot             breaking loads, verdicts, evidence\n"
      "  graspbench judge results/pilot --jobs 1    the same bytes, on one processor");
  const auto options = std::make_shared<JudgeOptions>();
  command.add_option("folder", options->folder, "folder of the session")
      ->required()
      ->option_text("DIR");
  AddJobsOption(command, options->num_workers, "grasps");
  command.add_flag("--json", options->json, "print the evidence as one JSON object");
  command.callback([options] {
    const std::filesystem::path folder = options->folder;
    JudgeTrials(*options, LoadSession(folder));
    const Session session = LoadSession(folder);
    ExportSession(folder, session);
    const std::filesystem::path report = WriteSessionReport(folder, session);
    const JudgeEvidence evidence = CalcJudgeEvidence(session.records);
    if (options->json) {
      PrintJson(ToJson(evidence));
    } else {
      PrintEvidence(evidence);
      std::cout << "\nreport   " << report.string() << "\ndata     "
                << (folder / "export" / "trials.csv").string() << '\n';
    }
  });
}

}  // namespace graspbench
