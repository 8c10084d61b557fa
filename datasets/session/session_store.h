#pragma once
/** @file
A session's folder:

    session.json          frozen configuration, schema and program version; its presence makes the
                          folder a session
    manifest.json         hashes of all that must not change and of what was committed (manifest.h)
    plan.jsonl            one planned trial a line
    journal/<n>.jsonl     append-only, one file per worker; a line = record + checksum, synced
    judge/<n>.jsonl       what `graspbench judge` found, see judgement_store.h
    index.sqlite          made from plan and journals, may be deleted at any time
    export/               trials.csv, events.csv, their dictionaries, records.jsonl
    report/index.html
    run.json              when, where, how long: the only file with clock and host

Finished = a valid journal line with the trial's id. Equal duplicates are fine, unequal ones are an
error. Resume = plan minus finished. Results hold no wall clock or host, and no absolute path but
those a person wrote into the configuration. session.json, plan.jsonl, index.sqlite and export/ have
the same bytes for any number of workers and any number of interruptions. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "datasets/journal/append_file.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/session/session_config.h"
#include "datasets/session/session_plan.h"
#include "datasets/session/trial_record.h"

namespace graspbench {

/** True when the folder holds a session, of whatever version and state. */
bool HasSession(const std::filesystem::path& folder);

/** Creates the folder with configuration and plan. @throws Error(kUsage) when it already holds a
session (suggesting --resume), Error(kIo) when it cannot be written. */
void CreateSession(const std::filesystem::path& folder, const SessionConfig& config,
                   const std::vector<PlannedTrial>& plan);

struct Session {
  SessionConfig config;
  std::vector<PlannedTrial> plan;
  std::vector<TrialRecord> records;  ///< finished trials in the plan's order
  /** Warnings about journal lines that were skipped; files are named from the session's folder. */
  Diagnostics findings;
  std::vector<Damage> damage;  ///< found and accepted
};
/** @throws Error(kNotFound) no session there; kVersion; kFormat for damage, which is looked for
before anything is read, and for unequal duplicates; kIo. */
Session LoadSession(const std::filesystem::path& folder, OnDamage on_damage = OnDamage::kRefuse);

/** The journals in a subfolder of the session's, by name; none when there is no such folder. */
std::vector<std::filesystem::path> ListJournals(const std::filesystem::path& folder,
                                                const std::string& subfolder = "journal");

/** What resuming has to run: the plan without the finished trials, in the plan's order. */
std::vector<PlannedTrial> FindUnfinished(const Session& session);

/** To be called before a session is resumed.
@throws Error(kUsage) listing the settings that differ, or the cells whose hand, object, grasp or
physics has changed since. */
void CheckSameSession(const Session& session, const SessionConfig& config,
                      const std::vector<PlannedTrial>& plan);

/** Appends finished trials to one worker's journal; see append_file.h. */
class JournalWriter {
 public:
  /** @throws Error(kIo) when the journal cannot be written or another process writes it. */
  JournalWriter(const std::filesystem::path& folder, int worker)
      : file_(folder / "journal" / (std::to_string(worker) + ".jsonl")) {}
  /** @throws Error(kIo) with the system's reason; what was appended before stays valid. */
  void Append(const TrialRecord& record) { file_.Append(FormatJournalLine(record) + "\n"); }

 private:
  AppendFile file_;
};

/** Writes index.sqlite and export/ from what LoadSession gives. Same records, same bytes. */
void ExportSession(const std::filesystem::path& folder, const Session& session);

}  // namespace graspbench
