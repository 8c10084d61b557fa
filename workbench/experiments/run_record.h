#pragma once
/** @file
run.json in a session's folder: when, where and for how long the program worked on it. Nothing else
in the folder holds a clock or a host, so the results of two runs can be compared byte by byte. */

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "datasets/shards/worker_log.h"
#include "workbench/experiments/observer.h"

namespace graspbench {

enum class RunEnding { kFinished, kInterrupted, kPlanned };
struct RunEndingRow {
  RunEnding value;
  const char* name;  // in run.json
};
inline constexpr RunEndingRow kRunEndings[] = {{RunEnding::kFinished, "finished"},
                                               {RunEnding::kInterrupted, "interrupted"},
                                               {RunEnding::kPlanned, "planned"}};

struct RunRecord {
  std::string started_utc;  ///< "2026-01-31T12:00:00Z"
  double duration = 0.0;    ///< [s]
  int num_workers = 0;
  int num_trials = 0;  ///< finished in this run
  RunEnding ending = RunEnding::kInterrupted;
};

std::string FormatUtcNow();

/** Adds the run to the list in run.json, with host and build. A run.json that cannot be read is
replaced: it says nothing about results. @throws Error(kIo). */
void AppendRunRecord(const std::filesystem::path& folder, const RunRecord& record);

/** Stands between one stage and its observer, and notes what run.json wants to know. */
class RunRecorder : public Observer {
 public:
  /** @pre the observer outlives it. */
  RunRecorder(std::filesystem::path folder, int num_workers, Observer& observer);

  void BeginStage(const Stage& stage) override { observer_.BeginStage(stage); }
  void ShowStatus(const BatchStatus& status, int num_trials) override {
    record_.num_trials = status.num_done;
    observer_.ShowStatus(status, num_trials);
  }
  void EndStage() override { observer_.EndStage(); }

  /** Adds the run to run.json. @returns what was added. @throws Error(kIo). */
  RunRecord Keep(bool is_complete);

 private:
  std::filesystem::path folder_;
  Observer& observer_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  RunRecord record_;
};

/** Notes in run.json which build has made the plan of a new session. @throws Error(kIo). */
void RecordPlanning(const std::filesystem::path& folder);

/** The builds of the program in run.json, a run each. */
std::vector<std::string> ListBuilds(const std::filesystem::path& folder);

/** True when an earlier run in run.json was made by another build of the program. */
bool HasRunOfAnotherBuild(const std::filesystem::path& folder);

std::string FindHost();

/** Two builds of one source are the same build when their bytes are. */
const std::string& FindBuild();

/** What this process runs on and is. */
Machine FindMachine();

/** At least 1. */
int CountProcessors();

}  // namespace graspbench
