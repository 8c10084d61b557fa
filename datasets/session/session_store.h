#pragma once
/** @file
A session's folder:

    session.json          frozen configuration, schema and program version; its presence makes the
                          folder a session
    manifest.json         hashes of all that must not change and of what was committed (manifest.h)
    plan.jsonl            one planned trial per line
    inputs/               the user's own hands, objects and grasps, see session_inputs.h
    journal/<n>.jsonl     append-only, one file per worker; a line = record + checksum, synced
    judge/<n>.jsonl       what `graspbench judge` found, see judgement_store.h
    sensitivity/<hash>/   sessions of the same draws under conditions (datasets/plan/conditions.h),
    numerics/<hash>/      each a separate store without inputs
    delays/<hash>/
    thresholds/<hash>/    likewise, with the trials that each draw's bisection required
    map/<part>/           the other sessions of a simultaneity map (datasets/plan/map_design.h)
    progress/<n>.jsonl    index of the shards' journals, see journal_index.h; may be deleted
    workers/<n>.jsonl     machines of the shards, and their sentinel trials, see worker_log.h
    index.sqlite          made from plan and journals, may be deleted at any time
    export/               trials.csv, events.csv, their dictionaries, datapackage.json; on
                          request records.jsonl, the complete records in the plan's order without
                          checksums; manifest.json
    report/               index.html, manifest.json
    ro-crate-metadata.json  on request: metadata for archives (ro_crate.h), with times
    run.json              date, host and duration of runs: the only file with a host

A trial is finished if there is a valid journal line with its id. Equal duplicates are accepted,
unequal ones are an error. Resuming runs the plan minus the finished trials. A worker of a shard
(shard.h) has its own journals, `SHARD-WORKER.jsonl`. It writes no other results, and does not read
what other workers write.

Results contain no wall-clock time, no host, and no absolute path except those that the user wrote
into the configuration. session.json, plan.jsonl, index.sqlite and export/ have the same bytes for
any number of workers and interruptions.

@code
const Session session = LoadSession("results/benchmark");
for (const TrialRecord& record : session.records) {
  const double forming_time = record.result.timing.gft;  // [s]; of record.trial_id
}
@endcode */

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "datasets/journal/append_file.h"
#include "datasets/journal/read_journal.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/plan/session_config.h"
#include "datasets/plan/session_plan.h"
#include "datasets/records/journal_index.h"
#include "datasets/records/trial_record.h"

namespace graspbench {

/** How much of each record is held in memory. A journal line of 7 kB takes 5 kB whole and 1 kB
brief. */
enum class RecordParts {
  kWhole,
  /** Without the parts that only exports, figures and single trials need: postures at contact,
  phases, contact events, snapshots, the loads of a judgement. LoadWhole reloads a record. */
  kBrief,
  /** No records, though all are read and checked: RecordLines locates each trial of the plan. */
  kPlaces
};

/** A session in memory, from LoadSession. */
struct Session {
  std::filesystem::path folder;  ///< from which it was loaded; empty: none
  SessionConfig config;
  int physics_version = 0;  ///< kPhysicsVersion of the program that planned it; 0: unknown
  std::vector<PlannedTrial> plan;
  std::vector<TrialRecord> records;  ///< finished trials in the plan's order
  RecordLines lines;                 ///< for kBrief and kPlaces; empty for kWhole
  /** Warnings about skipped journal lines, with file names relative to the session's folder. */
  Diagnostics findings;
  std::vector<Damage> damage;  ///< found and accepted
  /** Sentences about machines that disagree on a sentinel trial or have run none (worker_log.h). */
  std::vector<std::string> machine_differences = {};
};

/** Returns the complete form of one of session.records. Thread-safe.
@throws Error(kFormat, kIo) when its line has changed since the session was loaded. */
TrialRecord LoadWhole(const Session& session, const TrialRecord& record);

/** Calls `take(const TrialRecord&)` with the complete form of every record, in order. */
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

/** Returns the message about a valid line of a trial that is not in the plan. */
std::string DescribeForeign(const std::string& trial_id);

/** Whether the folder holds a session, of any version and state. */
bool HasSession(const std::filesystem::path& folder);

/** Creates the folder with configuration and plan. @throws Error(kUsage) when it already holds a
session (suggesting --resume), Error(kIo) when it cannot be written. */
void CreateSession(const std::filesystem::path& folder, const SessionConfig& config,
                   const std::vector<PlannedTrial>& plan);

/** Verifies and loads a session.
@throws Error(kNotFound, kVersion, kIo); kFormat for damage, which is checked first, for lines of
another session, and for unequal duplicates. */
Session LoadSession(const std::filesystem::path& folder, OnDamage on_damage = OnDamage::kRefuse,
                    RecordParts parts = RecordParts::kWhole);

/** Loads configuration and plan without reading any other file. @throws as LoadSession. */
Session LoadPlannedSession(const std::filesystem::path& folder);

/** Loads what a worker of a shard needs: configuration, plan, and brief records from the journals
that begin with `label` or come from a merge. Other journals are not read. @throws as
LoadSession. */
Session LoadShardOfSession(const std::filesystem::path& folder, const std::string& label);

/** Returns the trials to run when resuming: the plan without the finished trials, in its order. */
std::vector<PlannedTrial> FindUnfinished(const Session& session);

/** Checks that a session can be resumed with this configuration and plan.
@throws Error(kUsage) listing the settings that differ, or the cells whose hand, object, grasp or
physics has changed. */
void CheckSameSession(const Session& session, const SessionConfig& config,
                      const std::vector<PlannedTrial>& plan);

/** Appends finished trials to one worker's journal and, for a shard, to its index; see
append_file.h, journal_index.h. */
class JournalWriter {
 public:
  /** @param label  of a shard's worker. @throws Error(kIo) when the journal cannot be written or
  another process writes to it. */
  JournalWriter(const std::filesystem::path& folder, int worker, const std::string& label = "")
      : JournalWriter(FindJournal(folder / "journal", worker, label), !label.empty()) {}
  /** @throws Error(kIo) with the system's reason; earlier records stay valid. */
  void Append(const TrialRecord& record);

 private:
  JournalWriter(const std::filesystem::path& journal, bool has_index);

  AppendFile file_;
  std::optional<JournalIndex> index_;
};

/** A table in addition to those of trials and events. */
struct ExportTable {
  std::string name;  ///< of its file, without extension
  std::string csv;
  Json schema;  ///< its dictionary
};

/** Writes index.sqlite and export/ from a loaded session, record by record. Equal records give
equal bytes. @param with_records  also writes records.jsonl; an existing one is always rewritten.
@throws Error(kIo). */
void ExportSession(const std::filesystem::path& folder, const Session& session,
                   bool with_records = false, const std::vector<ExportTable>& more = {});

/** Reads records from damaged journal lines, for planned trials without a valid line, in the plan's
order. Their integrity cannot be verified: use them only for comparison with a re-simulation, which
shows what has changed. Lines that cannot be parsed are left out.
@pre the session was loaded despite its damage. @throws Error(kIo). */
std::vector<TrialRecord> ReadDamagedRecords(const Session& session);

}  // namespace graspbench
