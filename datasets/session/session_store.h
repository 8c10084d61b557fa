#pragma once
/** @file
A session's folder:

    session.json          frozen configuration, schema and program version; its presence makes the
                          folder a session
    manifest.json         hashes of all that must not change and of what was committed (manifest.h)
    plan.jsonl            one planned trial a line
    inputs/               the user's own hands, objects and grasps, see session_inputs.h
    journal/<n>.jsonl     append-only, one file per worker; a line = record + checksum, synced
    judge/<n>.jsonl       what `graspbench judge` found, see judgement_store.h
    sensitivity/<hash>/   sessions of the same draws under conditions (datasets/plan/conditions.h),
    numerics/<hash>/      each a store of its own, without inputs
    delays/<hash>/
    thresholds/<hash>/    of each draw those trials that its bisection asked for
    map/<part>/           of a map of simultaneity its other sessions (datasets/plan/map_design.h)
    progress/<n>.jsonl    what the journals of shards hold, see journal_index.h; may be deleted
    workers/<n>.jsonl     where shards were worked on, and their sentinel trials, see worker_log.h
    index.sqlite          made from plan and journals, may be deleted at any time
    export/               trials.csv, events.csv, their dictionaries, datapackage.json; when
                          asked for records.jsonl, the whole records in the plan's order, without
                          checksums; manifest.json
    report/               index.html, manifest.json
    ro-crate-metadata.json  when asked for: the folder for archives (ro_crate.h), with the clock
    run.json              when, where, how long: the only file with a host

Finished = a valid journal line with the trial's id. Equal duplicates are fine, unequal ones are an
error. Resume = plan minus finished. A worker of a shard (shard.h) has journals of its own,
`SHARD-WORKER.jsonl`, and neither writes anything else nor reads what the others write.

Results hold no wall clock or host, and no absolute path but those a person wrote into the
configuration. session.json, plan.jsonl, index.sqlite and export/ have
the same bytes for any number of workers and any number of interruptions.

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

/** How much of every record is held in memory: 7 kB of journal are 5 kB whole and 1 kB brief. */
enum class RecordParts {
  kWhole,
  /** Without what only exports, pictures and single trials need: postures at the touches, phases,
  contact events, snapshots, the loads of a judgement. LoadWhole reads a record again. */
  kBrief,
  /** None of them, though all are read and checked: RecordLines says where each of the plan is. */
  kPlaces
};

/** A session in memory, as LoadSession gives it. */
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

/** True when the folder holds a session, of whatever version and state. */
bool HasSession(const std::filesystem::path& folder);

/** Creates the folder with configuration and plan. @throws Error(kUsage) when it already holds a
session (suggesting --resume), Error(kIo) when it cannot be written. */
void CreateSession(const std::filesystem::path& folder, const SessionConfig& config,
                   const std::vector<PlannedTrial>& plan);

/** @throws Error(kNotFound) no session there; kVersion; kFormat for damage, which is looked for
before anything is read, for lines of another session, and for unequal duplicates; kIo. */
Session LoadSession(const std::filesystem::path& folder, OnDamage on_damage = OnDamage::kRefuse,
                    RecordParts parts = RecordParts::kWhole);

/** Configuration and plan, without a look at any other file. @throws as LoadSession. */
Session LoadPlannedSession(const std::filesystem::path& folder);

/** What a worker of a shard needs: configuration, plan, and the brief records in the journals that
begin with `label` or that a merge has brought. No other file is read. @throws as LoadSession. */
Session LoadShardOfSession(const std::filesystem::path& folder, const std::string& label);

/** What resuming has to run: the plan without the finished trials, in the plan's order. */
std::vector<PlannedTrial> FindUnfinished(const Session& session);

/** To be called before a session is resumed.
@throws Error(kUsage) listing the settings that differ, or the cells whose hand, object, grasp or
physics has changed since. */
void CheckSameSession(const Session& session, const SessionConfig& config,
                      const std::vector<PlannedTrial>& plan);

/** Appends finished trials to one worker's journal, and a shard's to its index; see append_file.h,
journal_index.h. */
class JournalWriter {
 public:
  /** @param label  of a shard's worker. @throws Error(kIo) when the journal cannot be written or
  another process writes it. */
  JournalWriter(const std::filesystem::path& folder, int worker, const std::string& label = "")
      : JournalWriter(FindJournal(folder / "journal", worker, label), !label.empty()) {}
  /** @throws Error(kIo) with the system's reason; what was appended before stays valid. */
  void Append(const TrialRecord& record);

 private:
  JournalWriter(const std::filesystem::path& journal, bool has_index);

  AppendFile file_;
  std::optional<JournalIndex> index_;
};

/** A table beside those of trials and events. */
struct ExportTable {
  std::string name;  ///< of its file, without ending
  std::string csv;
  Json schema;  ///< its dictionary
};

/** Writes index.sqlite and export/ from what LoadSession gives, record by record. Same records, same
bytes. @param with_records  also records.jsonl; where it is, it is always written again.
@throws Error(kIo). */
void ExportSession(const std::filesystem::path& folder, const Session& session,
                   bool with_records = false, const std::vector<ExportTable>& more = {});

/** What lines that fail their checksum still say. Its integrity cannot be verified: it is for a
comparison with the trial run again, which names what has changed, and for nothing else.

The records in the damaged lines of the session's journals whose trials are in the plan and have
no whole line, in the plan's order. A line that is no record any more is left out.
@pre the session was loaded despite its damage. @throws Error(kIo). */
std::vector<TrialRecord> ReadDamagedRecords(const Session& session);

}  // namespace graspbench
