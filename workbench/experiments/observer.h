#pragma once
/** @file
What an experiment reports while it runs, and who asks it to stop. Experiments neither print nor
know a terminal: whoever starts one passes an observer. */

#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/enum_table.h"
#include "core/trial/outcome.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {

enum class StageKind {
  kRun,
  kJudge,
  kOptimisation,
  kBenchmark,
  kComparison,
  kDevelopment,
  kReplay,
  kGrasps,
  kRehearsal,
  kExplain
};
struct StageRow {
  StageKind value;
  const char* name;
  const char *task, *tasks;  // one and several of what is counted
  const char* verb;          // what is done to them
  const char* counted;       // what its progress counts, several
  bool tells_success;        // whether the outcomes of these say how good the result is
};
inline constexpr StageRow kStages[] = {
    {StageKind::kRun, "run", "trial", "trials", "run", "trials", true},
    {StageKind::kJudge, "judge", "held grasp", "held grasps", "judge", "held grasps", false},
    {StageKind::kOptimisation, "optimisation", "scene", "scenes", "optimise", "evaluations", false},
    {StageKind::kBenchmark, "benchmark", "trial", "trials", "run", "trials", true},
    {StageKind::kComparison, "comparison", "search", "searches", "run", "evaluations", false},
    {StageKind::kDevelopment, "development", "grasp", "grasps", "develop", "trials", false},
    {StageKind::kReplay, "replay", "trial", "trials", "replay", "trials", true},
    {StageKind::kGrasps, "grasps", "verdict", "verdicts", "find", "verdicts", false},
    {StageKind::kRehearsal, "rehearsal", "pair of hand and object", "pairs of hand and object",
     "rehearse", "pairs", true},
    {StageKind::kExplain, "explain", "failure", "failures", "explain", "failures", false}};

/** A part of an experiment with a progress of its own. */
struct Stage {
  StageKind kind = StageKind::kRun;
  int num_all = 0;                ///< tasks, as the kind's row says
  int num_left = 0;               ///< of those; 0: finished before, nothing runs
  int num_trials = 0;             ///< at most, with those of earlier runs
  std::map<Outcome, int> before;  ///< of trials that earlier runs finished
};

struct BatchStatus {
  int num_done = 0;                               ///< trials, in this run
  std::map<Outcome, int> outcomes;                ///< of those
  std::vector<std::optional<PlannedTrial>> busy;  ///< each worker's current trial
  std::map<int, std::string> preparing;           ///< by worker: the object of its next trial
  /** Of trials that cost differently, in any unit: what was computed in this run, and what is left.
  0: all cost the same. */
  double work_done = 0.0, work_left = 0.0;
};

/** Of so many tasks that nobody has begun, each one trial. */
inline Stage MakeStage(StageKind kind, size_t num_tasks) {
  const int num = static_cast<int>(num_tasks);
  return {kind, num, num, num, {}};
}

/** Called in the thread that started the experiment. */
class Observer {
 public:
  /** It never asks to stop. */
  Observer() = default;
  /** @param stop  when set, the experiment ends soon and keeps what is finished; outlives this. */
  explicit Observer(const std::atomic<bool>& stop) : stop_(stop) {}
  virtual ~Observer() = default;

  const std::atomic<bool>& stop() const { return stop_; }
  virtual void BeginStage(const Stage&) {}
  /** About ten times a second. @param num_trials  those of the stage, as far as known by now. */
  virtual void ShowStatus(const BatchStatus&, int num_trials) { static_cast<void>(num_trials); }
  /** Not called for a stage in which nothing runs or that throws. */
  virtual void EndStage() {}

 private:
  static inline const std::atomic<bool> never_{false};
  const std::atomic<bool>& stop_ = never_;
};

/** The status that several workers change. */
class StatusBoard {
 public:
  explicit StatusBoard(int num_workers) { status_.busy.resize(static_cast<size_t>(num_workers)); }

  void SetBusy(int worker, std::optional<PlannedTrial> trial) {
    const std::lock_guard lock(mutex_);
    // A worker that was given up keeps its place, and the one in its stead gets a new one.
    const auto place = static_cast<size_t>(worker);
    if (place >= status_.busy.size()) status_.busy.resize(place + 1);
    status_.busy[place] = std::move(trial);
    status_.preparing.erase(worker);
  }
  void SetPreparing(int worker, const std::string& object) {
    const std::lock_guard lock(mutex_);
    status_.preparing[worker] = object;
  }
  void Count(Outcome outcome) {
    const std::lock_guard lock(mutex_);
    ++status_.num_done;
    ++status_.outcomes[outcome];
  }
  BatchStatus Read() const {
    const std::lock_guard lock(mutex_);
    return status_;
  }

 private:
  mutable std::mutex mutex_;
  BatchStatus status_;
};

}  // namespace graspbench
