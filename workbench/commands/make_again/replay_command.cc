#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/text/text.h"
#include "datasets/session/find_trial.h"
#include "workbench/command.h"
#include "workbench/experiments/replay_session.h"
#include "workbench/stage_commands.h"
#include "workbench/terminal/terminal_observer.h"
#include "workbench/text/trial_text.h"
#include "workbench/trial_files.h"

namespace graspbench {
namespace {

struct ReplayOptions {
  std::filesystem::path folder;
  std::vector<std::string> names;
  bool failed = false, all = false, verify = false;
  int num_workers = 1;
  double trial_time_limit = kTrialTimeLimit;
  OnDamage on_damage = OnDamage::kRefuse;
  TrajectoryRequest trajectory;
  bool json = false;
};

/** The trials that are asked for, in the plan's order. */
std::vector<PlannedTrial> FindReplayTrials(const Session& session, const ReplayOptions& options) {
  if (options.names.empty() && !options.failed && !options.all) {
    throw Error(
        ErrorKind::kUsage,
        "no trial is named; name trials (tum-can-g2:3 or a trial_id), or give --failed or --all");
  }
  if (options.all) return session.plan;
  std::set<std::string> wanted;
  for (const std::string& name : options.names) wanted.insert(FindPlannedTrial(session, name).id);
  if (options.failed) {
    for (const TrialRecord& record : session.records) {
      if (!IsSuccess(record.result.outcome)) wanted.insert(record.plan.id);
    }
  }
  std::vector<PlannedTrial> trials;
  for (const PlannedTrial& planned : session.plan) {
    if (wanted.count(planned.id) > 0) trials.push_back(planned);
  }
  return trials;
}

void WriteTrajectories(TrajectoryOutput& output) {
  for (const std::filesystem::path& path : output.Commit()) PrintMessage(path.string());
  if (output.num_skipped() == 0) return;
  PrintMessage(FormatCount(output.num_skipped(), "trial") +
               " could not begin, so there is no motion to write");
}

ExitCode ReplayWholePack(const Command& program, const ReplayOptions& options) {
  if (options.failed || !options.names.empty() || !options.trajectory.name.empty()) {
    throw Error(ErrorKind::kUsage, "a packed pipeline is replayed as a whole; name no trials");
  }
  return ReplayPackFile(program, {options.folder, {}, options.num_workers, options.json});
}

ExitCode Replay(ReplayOptions options) {
  options.trajectory.session = options.folder;
  if (options.trajectory.name.empty() && options.trajectory.replace) {
    throw Error(ErrorKind::kUsage, "--replace requires --trajectory and --out");
  }
  const Session session = LoadSession(options.folder, options.on_damage, RecordParts::kBrief);
  if (!session.damage.empty()) PrintMessage("damage accepted" + FormatDamage(session.damage));
  ReplayRequest request;
  request.trials = FindReplayTrials(session, options);
  request.num_workers = options.num_workers;
  request.trial_time_limit = options.trial_time_limit;
  std::optional<TrajectoryOutput> output;
  if (!options.trajectory.name.empty()) {
    output.emplace(options.trajectory, request.trials.size());
    request.take = [&](size_t trial, const TrialSetup& setup, const TracedTrial& traced) {
      output->Take(trial, request.trials[trial], setup, traced);
    };
  }
  const SessionInputs inputs = LoadSessionInputs(session.config, FieldUse::kLater, session.folder);
  TerminalObserver observer(
      [&](const Stage& stage) { return options.folder.string() + ": " + DescribeTasks(stage); });
  SessionReplay replay = ReplaySession(session, inputs, request, observer);
  replay.conditions = FindReplayConditions(session, inputs);
  if (options.json) {
    PrintJson(MakeReplayJson(replay, options.folder.string()));
  } else {
    PrintResult(FormatReplay(replay, !options.verify));
  }
  if (output) WriteTrajectories(*output);
  const bool is_missing = options.verify && replay.CountMissing() > 0;
  return replay.CountDifferent() > 0 || is_missing ? kExitBadInput : kExitOk;
}

}  // namespace

void AddReplayCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "replay", "Simulate trials of a session again and compare them with their records.",
      "  graspbench replay results/pilot --all --verify    exit code 3 when one differs\n"
      "  graspbench replay pilot.tar --verify              a packed pipeline, byte for byte\n"
      "  graspbench replay results/pilot tum-can-g2:3 --trajectory trial.mcap\n"
      "  graspbench replay results/pilot --failed --trajectory h5 --out failed");
  const auto options = std::make_shared<ReplayOptions>();
  TrajectoryRequest& trajectory = options->trajectory;
  AddStoreFolder(command, options->folder, "session, DIR/benchmark of a campaign, or pack");
  command.AddOption("trials", options->names,
                    "trials: trial_id, its first letters, or hand-object-grasp:number",
                    "ID|CONDITION:N ..");
  Option* failed = command.AddFlag("--failed", options->failed, "all finished trials that failed");
  command.AddFlag("--all", options->all, "every trial of the plan")->Excludes(failed);
  command.AddFlag(
      "--verify", options->verify,
      "list only trials that differ from their record, and count trials without a record");
  std::string forms;
  for (const TrajectoryForm& form : ListTrajectoryForms()) {
    forms += (forms.empty() ? "" : "; ") + std::string(form.name) + ": " + form.text;
  }
  command.AddOption("--trajectory", trajectory.name, "write what happened; " + forms, "FILE|FORM");
  command.AddOption("--fps", trajectory.rate, "samples per second of a trajectory", "RATE")
      ->Within(1.0, 1000.0)
      ->ShowDefault("60")
      ->Needs("--trajectory");
  command.AddOption("--out", trajectory.out, "new folder for trajectories of FORM", "DIR")
      ->Needs("--trajectory");
  AddReplaceOption(command, trajectory.replace);
  AddJobsOption(command, options->num_workers);
  AddTrialTimeoutOption(command, options->trial_time_limit);
  AddAcceptDamageOption(command, options->on_damage);
  AddJsonOption(command, options->json);
  command.SetAction([&program, options] {
    const bool is_file = std::filesystem::is_regular_file(options->folder);
    return is_file ? ReplayWholePack(program, *options) : Replay(*options);
  });
}

}  // namespace graspbench
