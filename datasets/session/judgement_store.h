#pragma once
/** @file
Judgements of a session's held grasps, in its folder beside the trials:

    judge/<n>.jsonl     append-only, one file per worker; a line = trial id, version of the judge,
                        judgement, checksum; synced

Judged = a valid line with the trial's id and today's version of the judge; what an earlier version
has found counts as not judged. Equal duplicates are fine, unequal ones are an error. */

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/journal/append_file.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Appends to one worker's file; each Append is on the disk when it returns. */
class JudgementWriter {
 public:
  /** @throws Error(kIo) as JournalWriter. */
  JudgementWriter(const std::filesystem::path& folder, int worker, const std::string& label = "");
  void Append(const std::string& trial_id, const Judgement& judgement);

 private:
  AppendFile file_;
};

/** Joins the stored judgements to session.records, brief to brief ones; damaged lines become
findings, lines of trials that are not in the plan session.damage.
@throws Error(kFormat) for unequal duplicates, Error(kIo). */
void LoadJudgements(const std::filesystem::path& folder, Session& session);

/** Whether somebody has begun to judge the session in the folder. */
bool HasBegunJudge(const std::filesystem::path& folder);

/** Trials that the judge can say something about and has not yet: those whose object was in the
hand when the hold ended, in the plan's order. */
std::vector<PlannedTrial> FindUnjudged(const Session& session);

}  // namespace graspbench
