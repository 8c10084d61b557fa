#pragma once
/** @file
Interface for the progress reports of an experiment and for stop requests. Experiments neither print
nor know a terminal: the caller passes an observer. */

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
  const char *task, *tasks;  // singular and plural of a task
  const char* verb;          // what is done to a task
  const char* counted;       // plural of what the progress counts
  bool tells_success;        // whether their outcomes show the quality of the result
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
     "rehearse", "pairs", false},
    {StageKind::kExplain, "explain", "failure", "failures", "explain", "failures", false}};

/** A part of an experiment with its own progress. */
struct Stage {
  StageKind kind = StageKind::kRun;
  int num_all = 0;                ///< tasks in the sense of kStages
  int num_left = 0;               ///< tasks left; 0: nothing runs
  int num_trials = 0;             ///< upper bound, including earlier runs
  std::map<Outcome, int> before;  ///< of trials that earlier runs finished
};

struct BatchStatus {
  int num_done = 0;                               ///< trials finished in this run
  std::map<Outcome, int> outcomes;                ///< of these trials
  std::vector<std::optional<PlannedTrial>> busy;  ///< each worker's current trial
  std::map<int, std::string> preparing;           ///< by worker: the object of its next trial
  /** For trials of different cost, in any unit: work done in this run, and work left. 0: equal
  cost. */
  double work_done = 0.0, work_left = 0.0;
};

/** Makes a stage of tasks of one trial each, none begun. */
inline Stage MakeStage(StageKind kind, size_t num_tasks) {
  const int num = static_cast<int>(num_tasks);
  return {kind, num, num, num, {}};
}

/** Receives progress, in the thread that started the experiment. */
class Observer {
 public:
  /** Makes an observer that never requests a stop. */
  Observer() = default;
  /** @param stop  when set, the experiment ends soon and keeps what is finished; it must outlive
  this. */
  explicit Observer(const std::atomic<bool>& stop) : stop_(stop) {}
  virtual ~Observer() = default;

  const std::atomic<bool>& stop() const { return stop_; }
  virtual void BeginStage(const Stage&) {}
  /** Called about ten times a second. @param num_trials  trials of the stage, as far as known. */
  virtual void ShowStatus(const BatchStatus&, int num_trials) { static_cast<void>(num_trials); }
  /** Not called for a stage that runs nothing or throws. */
  virtual void EndStage() {}

 private:
  static inline const std::atomic<bool> never_{false};
  const std::atomic<bool>& stop_ = never_;
};

/** A status shared by several workers; thread-safe. */
class StatusBoard {
 public:
  explicit StatusBoard(int num_workers) { status_.busy.resize(static_cast<size_t>(num_workers)); }

  void SetBusy(int worker, std::optional<PlannedTrial> trial) {
    const std::lock_guard lock(mutex_);
    // An abandoned worker keeps its place, and its replacement gets a new one.
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
