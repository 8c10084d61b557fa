#pragma once
/** @file
A session in memory, as LoadSession (session_store.h) gives it. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/plan/session_config.h"
#include "datasets/plan/session_plan.h"
#include "datasets/records/record_lines.h"
#include "datasets/records/trial_record.h"

namespace graspbench {

/** How much of every record is held in memory: 7 kB of journal are 5 kB whole and 1 kB brief. */
enum class RecordParts {
  kWhole,
  /** Without what only exports, pictures and single trials need: postures at the touches, phases,
  contact events, snapshots, the loads of a judgement. LoadWhole reads a record again. */
  kBrief,
  /** None of them, though all are read and checked: RecordLines says where each of the plan is. */
  kPlaces
};

struct Session {
  std::filesystem::path folder;  ///< it was loaded from; empty: it stands in none
  SessionConfig config;
  int physics_version = 0;  ///< kPhysicsVersion of the program that planned it; 0: not said
  std::vector<PlannedTrial> plan;
  std::vector<TrialRecord> records;  ///< finished trials in the plan's order
  RecordLines lines;                 ///< of brief records and of places; empty when they are whole
  /** Warnings about journal lines that were skipped; files are named from the session's folder. */
  Diagnostics findings;
  std::vector<Damage> damage;  ///< found and accepted
  /** Machines that did not agree on a sentinel trial or have run none, as sentences
  (worker_log.h). */
  std::vector<std::string> machine_differences = {};
};

/** The whole of one of session.records. Several threads may ask.
@throws Error(kFormat, kIo) when its line is not what it was when the session was loaded. */
TrialRecord LoadWhole(const Session& session, const TrialRecord& record);

/** Calls `take(const TrialRecord&)` for the whole of every record, in their order. */
template <class Take>
void ForEachWhole(const Session& session, Take&& take) {
  for (const TrialRecord& record : session.records) {
    if (session.lines.trials.empty()) {
      take(record);
    } else {
      take(LoadWhole(session, record));
    }
  }
}

/** What is wrong with a whole line of a trial that is not in the plan. */
std::string DescribeForeign(const std::string& trial_id);

}  // namespace graspbench
