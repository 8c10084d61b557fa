#include "workbench/experiments/replay_session.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <unordered_map>

#include "core/base/error.h"
#include "core/trial/trial_trace.h"
#include "datasets/session/find_trial.h"
#include "datasets/session/session_store.h"
#include "datasets/shards/worker_log.h"
#include "workbench/experiments/pool/batch_runner.h"
#include "workbench/experiments/run_record.h"

namespace graspbench {
namespace {

/** The records of the trials that are replayed, by id. */
class RecordFinder {
 public:
  explicit RecordFinder(const Session& session)
      : session_(session), damaged_(ReadDamagedRecords(session)) {
    for (const TrialRecord& record : session.records) whole_[record.plan.id] = &record;
    for (const TrialRecord& record : damaged_) broken_[record.plan.id] = &record;
  }

  void Compare(const TrialRecord& now, ReplayedTrial& trial) const {
    trial.outcome = now.result.outcome;
    const auto whole = whole_.find(trial.planned.id);
    const auto broken = broken_.find(trial.planned.id);
    if (whole != whole_.end()) {
      trial.is_recorded = true;
      trial.difference = FindFirstDifference(LoadWhole(session_, *whole->second), now);
    } else if (broken != broken_.end()) {
      trial.is_recorded = trial.is_damaged = true;
      trial.difference = FindFirstDifference(*broken->second, now);
    }
  }

 private:
  const Session& session_;
  std::vector<TrialRecord> damaged_;
  std::unordered_map<std::string, const TrialRecord*> whole_, broken_;  // looked up only
};

std::set<std::string> FindRecordedBuilds(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> places = {folder};
  if (FindStoreKind(folder / "..") == &kCampaignStore) places.push_back(folder / "..");
  std::set<std::string> builds;
  for (const std::filesystem::path& place : places) {
    for (const std::string& build : ListBuilds(place)) builds.insert(build);
    Diagnostics findings;  // of which loading the session has told
    for (const WorkerStart& start : LoadWorkers(place, findings).starts) {
      builds.insert(start.machine.build);
    }
  }
  return builds;
}

}  // namespace

bool ReplayConditions::is_other_build() const {
  return std::any_of(recorded_builds.begin(), recorded_builds.end(),
                     [this](const std::string& recorded) { return recorded != build; });
}

int SessionReplay::CountDifferent() const {
  return static_cast<int>(
      std::count_if(trials.begin(), trials.end(),
                    [](const ReplayedTrial& trial) { return trial.difference.has_value(); }));
}

int SessionReplay::CountMissing() const {
  return static_cast<int>(std::count_if(
      trials.begin(), trials.end(), [](const ReplayedTrial& trial) { return !trial.is_recorded; }));
}

ReplayConditions FindReplayConditions(const Session& session, const SessionInputs& inputs) {
  ReplayConditions conditions;
  conditions.recorded_physics = session.physics_version;
  conditions.physics = kPhysicsVersion;
  const std::set<std::string> builds = FindRecordedBuilds(session.folder);
  conditions.recorded_builds.assign(builds.begin(), builds.end());
  conditions.build = FindBuild();
  std::set<std::string> now;
  for (const PlannedTrial& planned : MakePlan(session.config, inputs)) now.insert(planned.id);
  for (const PlannedTrial& planned : session.plan) {
    conditions.num_changed += now.count(planned.id) == 0;
  }
  return conditions;
}

SessionReplay ReplaySession(const Session& session, const SessionInputs& inputs,
                            const ReplayRequest& request, Observer& observer) {
  const RecordFinder records(session);
  SessionReplay replay;
  std::unordered_map<std::string, size_t> places;  // in the request
  for (const PlannedTrial& planned : request.trials) {
    places[planned.id] = replay.trials.size();
    replay.trials.push_back({planned, false, false, Outcome::kNotRun, std::nullopt});
  }
  const auto compare = [&](const TrialRecord& now) {  // each trial has a place of its own
    records.Compare(now, replay.trials[places.at(now.plan.id)]);
  };
  const auto make_worker = [&](int) {
    const auto traced = std::make_shared<TracedTrial>();  // of the trial that has just run
    const auto keep = [&, traced](const TrialRecord& now) {
      compare(now);
      if (!request.take) return;
      request.take(places.at(now.plan.id), MakeRecordedSetup(session, inputs, now.plan), *traced);
    };
    CarryOut trace;
    if (request.take) {
      trace = [traced](TrialRunner& runner, const TrialSetup& setup) {
        *traced = TraceTrial(runner, setup, 0.0);
        return traced->result;
      };
    }
    BatchWorker worker =
        MakeTrialWorker(session.config, inputs, keep, trace, MakeRecordedPolicies(session));
    worker.give_up = compare;
    return worker;
  };
  if (!RunBatch(MakeStage(StageKind::kReplay, request.trials.size()), request.trials,
                request.num_workers, make_worker, observer, request.trial_time_limit)) {
    throw Error(ErrorKind::kInterrupted,
                "stopped before all trials were compared; nothing was written. Repeat the command "
                "to start again");
  }
  return replay;
}

}  // namespace graspbench
