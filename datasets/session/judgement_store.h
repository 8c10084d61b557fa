#pragma once
/** @file
Judgements of a session's held grasps, in its folder:

    judge/<n>.jsonl     append-only, one file per worker; a line = trial id, version of the judge,
                        judgement, checksum; synced

A trial is judged if there is a valid line with its id and the current version of the judge; results
of an earlier version do not count. Equal duplicates are accepted, unequal ones are an error. */

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/journal/append_file.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Appends to one worker's file; a line is on disk when Append returns. */
class JudgementWriter {
 public:
  /** @throws Error(kIo) as JournalWriter. */
  JudgementWriter(const std::filesystem::path& folder, int worker, const std::string& label = "");
  void Append(const std::string& trial_id, const Judgement& judgement);

 private:
  AppendFile file_;
};

/** Adds the stored judgements to session.records, in brief form if the records are brief. Damaged
lines go to session.findings, lines of trials that are not in the plan to session.damage.
@throws Error(kFormat) for unequal duplicates; Error(kIo). */
void LoadJudgements(const std::filesystem::path& folder, Session& session);

/** Whether judging the session in the folder has begun. */
bool HasBegunJudge(const std::filesystem::path& folder);

/** Lists trials that can be judged and are not yet: those whose object was in the hand at the end
of the hold, in the plan's order. */
std::vector<PlannedTrial> FindUnjudged(const Session& session);

}  // namespace graspbench
