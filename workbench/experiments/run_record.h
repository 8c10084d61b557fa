#pragma once
/** @file
run.json in a session's folder: when, where and for how long the program worked on it. Nothing else
in the folder holds a clock or a host, so the results of two runs can be compared byte by byte. */

#include <filesystem>
#include <string>

#include "core/base/json.h"

namespace graspbench {

struct RunRecord {
  std::string started_utc;  ///< "2026-01-31T12:00:00Z"
  double duration = 0.0;    ///< [s]
  int num_workers = 0;
  int num_trials = 0;  ///< finished in this run
  std::string ending;  ///< "finished", "interrupted" or the message of the error
};

std::string FormatUtcNow();

/** Adds the run to the list in run.json, with host and build. A run.json that cannot be read is
replaced: it says nothing about results. @throws Error(kIo). */
void AppendRunRecord(const std::filesystem::path& folder, const RunRecord& record);

/** True when an earlier run in run.json was made by another build of the program. */
bool HasRunOfAnotherBuild(const std::filesystem::path& folder);

}  // namespace graspbench
