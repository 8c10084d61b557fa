#pragma once
/** @file
run.json in a session's folder: when, where and for how long the program worked on it. No other file
in the folder holds a time or a host name, so the results of two runs can be compared byte by
byte. */

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
replaced, since it contains no results. @throws Error(kIo). */
void AppendRunRecord(const std::filesystem::path& folder, const RunRecord& record);

/** Forwards a stage to its observer and records the entries of run.json. */
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

/** Records in run.json which build has planned a new session. @throws Error(kIo). */
void RecordPlanning(const std::filesystem::path& folder);

/** Lists the builds of the program in run.json, one per run. */
std::vector<std::string> ListBuilds(const std::filesystem::path& folder);

/** Whether run.json lists a run by another build of the program. */
bool HasRunOfAnotherBuild(const std::filesystem::path& folder);

std::string FindHost();

/** Identifies this build by its bytes: builds of one source are the same build if their bytes are
equal. */
const std::string& FindBuild();

/** Returns the machine and the build of this process. */
Machine FindMachine();

/** Returns at least 1. */
int CountProcessors();

}  // namespace graspbench
