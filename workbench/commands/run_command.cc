#include <errno.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/files.h"
#include "core/base/hash.h"
#include "core/base/text.h"
#include "datasets/analysis/session_summary.h"
#include "datasets/session/session_store.h"
#include "reports/session_report.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/batch_runner.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/run_record.h"
#include "workbench/experiments/session_worker.h"
#include "workbench/progress.h"
#include "workbench/summary_table.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct RunOptions {
  std::string session_file;
  std::vector<std::string> hands, objects, grasps;
  std::optional<int> trials, seed;
  std::vector<std::string> settings;
  int num_workers = 1;
  std::string out;
  bool resume = false;
  bool json = false;

  bool HasSettings() const {
    return !session_file.empty() || !hands.empty() || !objects.empty() || !grasps.empty() ||
           trials || seed || !settings.empty();
  }
};

SessionConfig MakeConfig(const RunOptions& options) {
  SessionConfig config;
  if (!options.session_file.empty()) config = LoadSessionConfig(options.session_file);
  for (const std::string& setting : options.settings) ApplySetting(setting, config);
  if (!options.hands.empty()) config.hands = options.hands;
  if (!options.objects.empty()) config.objects = options.objects;
  if (!options.grasps.empty()) config.grasps = options.grasps;
  if (options.trials) config.trials = *options.trials;
  if (options.seed) config.seed = *options.seed;
  return config;
}

/** Without --out a session's folder is named by its plan, so the same session always has the same
folder and another one never gets in its way. */
fs::path FindFolder(const RunOptions& options, const std::vector<PlannedTrial>& plan) {
  if (!options.out.empty()) return options.out;
  std::string ids;
  for (const PlannedTrial& planned : plan) ids += planned.id;
  const std::string name =
      options.session_file.empty() ? "benchmark" : fs::path(options.session_file).stem().string();
  return fs::path("results") / (name + "-" + CalcHashHex(ids).substr(0, 8));
}

std::string QuoteForShell(const std::string& text) {
  constexpr char kPlain[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./-+=:,@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string FormatResumeCommand(const RunOptions& options, const fs::path& folder) {
  return QuoteForShell(program_invocation_name) + " run --resume --out " +
         QuoteForShell(folder.string()) + " --jobs " + std::to_string(options.num_workers);
}

/** What to run: a new session, or the rest of one. */
struct Work {
  SessionConfig config;
  SessionInputs inputs;
  fs::path folder;
  Session session;
};

Work Prepare(const RunOptions& options) {
  Work work;
  const bool names_a_session = options.resume && !options.out.empty();
  if (names_a_session) work.session = LoadSession(options.out);
  work.config =
      names_a_session && !options.HasSettings() ? work.session.config : MakeConfig(options);
  work.inputs = LoadSessionInputs(work.config);
  const std::vector<PlannedTrial> plan = MakePlan(work.config, work.inputs);
  work.folder = FindFolder(options, plan);
  const bool may_continue = options.resume || options.out.empty();
  if (!may_continue || !HasSession(work.folder)) CreateSession(work.folder, work.config, plan);
  if (!names_a_session) work.session = LoadSession(work.folder);
  CheckSameSession(work.session, work.config, plan);
  return work;
}

void PrintStart(const Work& work, int num_unfinished, int num_workers) {
  const int num_finished = static_cast<int>(work.session.records.size());
  if (work.session.findings.entries().size() > 0) {
    std::cerr << work.session.findings.Format() << '\n';
  }
  if (num_finished > 0 && HasRunOfAnotherBuild(work.folder)) {
    std::cerr << "note: trials in this session were finished by another build of graspbench; "
                 "--out DIR starts afresh\n";
  }
  std::cerr << work.folder.string() << ": " << FormatCount(num_finished + num_unfinished, "trial");
  if (num_unfinished == 0) {
    std::cerr << ", all finished before\n";
  } else {
    std::cerr << ", " << num_finished << " finished before, " << num_unfinished << " to run on "
              << FormatCount(num_workers, "worker") << '\n';
  }
}

bool RunTrials(const Work& work, const std::vector<PlannedTrial>& trials, int num_workers,
               RunRecord& record) {
  std::map<Outcome, int> before;
  for (const TrialRecord& finished : work.session.records) ++before[finished.result.outcome];
  Progress progress(stderr, static_cast<int>(work.session.plan.size()), before);
  const std::atomic<bool>& stop = CatchInterrupts();
  const auto start = std::chrono::steady_clock::now();
  bool has_told = false;
  const auto show = [&](const BatchStatus& status) {
    record.duration =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    record.num_trials = status.num_done;
    if (stop && !has_told) {
      progress.Say("stopping after the current trials; once more to stop at once");
      has_told = true;
    }
    progress.Show(status, record.duration);
  };
  const bool is_complete = RunBatch(
      trials, num_workers, MakeSessionWorkers(work.config, work.inputs, work.folder), show, stop);
  progress.Finish();
  return is_complete;
}

ExitCode Finish(const Work& work, bool json) {
  const Session session = LoadSession(work.folder);
  ExportSession(work.folder, session);
  const fs::path report = WriteSessionReport(work.folder, session);
  const SessionSummary summary = SummariseSession(session);
  if (json) {
    PrintJson(MakeSummaryJson(summary, work.folder, report));
  } else {
    std::cout << '\n'
              << FormatSummaryTable(summary) << "\nreport   " << report.string() << "\ndata     "
              << (work.folder / "export" / "trials.csv").string() << "\nnext     xdg-open "
              << QuoteForShell(report.string()) << '\n';
  }
  return summary.total.CountOf(Outcome::kNumericalFailure) > 0 ? kExitNumericalFailures : kExitOk;
}

ExitCode Run(const RunOptions& options) {
  const Work work = Prepare(options);
  const std::vector<PlannedTrial> trials = FindUnfinished(work.session);
  const int num_trials = static_cast<int>(trials.size());
  const int num_workers = std::max(1, std::min(options.num_workers, num_trials));
  PrintStart(work, num_trials, num_workers);
  if (trials.empty()) return Finish(work, options.json);

  RunRecord record;
  record.started_utc = FormatUtcNow();
  record.num_workers = num_workers;
  try {
    const bool is_complete = RunTrials(work, trials, num_workers, record);
    record.ending = is_complete ? "finished" : "interrupted";
    AppendRunRecord(work.folder, record);
    if (is_complete) return Finish(work, options.json);
  } catch (const Error& error) {
    throw Error(error.kind(), std::string(error.what()) +
                                  "\nFinished trials are kept. Continue with\n  " +
                                  FormatResumeCommand(options, work.folder));
  }
  throw Error(ErrorKind::kInterrupted,
              "stopped; " + std::to_string(num_trials - record.num_trials) +
                  " trials are left and the finished ones are kept. Continue with\n  " +
                  FormatResumeCommand(options, work.folder));
}

}  // namespace

void AddRunCommand(CLI::App& program, ExitCode& exit_code) {
  CLI::App& command = AddSubcommand(
      program, "run", "Runs a benchmark session and writes its report.",
      "  graspbench run                       both hands, 21 objects, 10 trials each\n"
      "  graspbench run --hand shadow --object can,cup --grasp all --trials 3");
  const auto options = std::make_shared<RunOptions>();
  command
      .add_option("session", options->session_file, "session file (YAML); absent: the benchmark")
      ->option_text("SESSION.YAML");
  AddSceneOptions(command, options->hands, options->objects);
  AddListOption(command, "--grasp", options->grasps,
                "best, all, ids or grasp files: g1,my.yaml (default best)", "G,..");
  command
      .add_option("--trials", options->trials, "trials of each hand, object, grasp (default 10)")
      ->option_text("N");
  command.add_option("--seed", options->seed, "another seed gives other variations (default 1)")
      ->option_text("N");
  AddSettingsOption(command, options->settings, "sim.step_s=0.001");
  AddJobsOption(command, options->num_workers);
  command.add_option("--out", options->out, "folder of the session (default: results/NAME-HASH)")
      ->option_text("DIR");
  command.add_flag("--resume", options->resume, "continue the session in the folder of --out");
  command.add_flag("--json", options->json, "print the summary as one JSON object");
  command.callback([options, &exit_code] { exit_code = Run(*options); });
}

}  // namespace graspbench
