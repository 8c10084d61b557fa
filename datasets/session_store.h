#pragma once
/** @file
A session's folder:

    session.json          frozen configuration, schema and program version
    plan.jsonl            one planned trial a line
    journal/<n>.jsonl     append-only, one file per worker; a line = record + checksum, synced
    index.sqlite          made from plan and journals, may be deleted at any time
    export/trials.csv     and other exports
    report/index.html
    run.json              when, where, how long: the only file with clock and host

Finished = a valid journal line with the trial's id. Equal duplicates are fine, unequal ones are an
error. Resume = plan minus finished. Results hold no wall clock, host or absolute path. */

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "datasets/session_config.h"
#include "datasets/session_plan.h"

namespace graspbench {

struct TrialRecord {
  PlannedTrial plan;
  TrialResult result;
};

/** Creates the folder with configuration and plan. @throws Error(kUsage) when it already holds a
session (suggesting --resume), Error(kIo) when it cannot be written. */
void CreateSession(const std::filesystem::path& folder, const SessionConfig& config,
                   const std::vector<PlannedTrial>& plan);

struct Session {
  SessionConfig config;
  std::vector<PlannedTrial> plan;
  std::vector<TrialRecord> records;  ///< finished trials in the plan's order
  Diagnostics findings;              ///< torn or damaged journal lines that were skipped
};
/** @throws Error(kNotFound) no session there; kVersion; kFormat for unequal duplicates. */
Session LoadSession(const std::filesystem::path& folder);

/** Appends finished trials to one worker's journal; each Append is on the disk when it returns. */
class JournalWriter {
 public:
  JournalWriter(const std::filesystem::path& folder, int worker);
  ~JournalWriter();
  /** @throws Error(kIo) with the system's reason; what was appended before stays valid. */
  void Append(const TrialRecord& record);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/** Writes index.sqlite and export/trials.csv from what LoadSession gives. Same records, same bytes.
 */
void ExportSession(const std::filesystem::path& folder, const Session& session);

}  // namespace graspbench
