#pragma once
/** @file
Explanations of a session's failures (core/trial/remedies.h), in its folder beside the trials:

    explain/<n>.jsonl   append-only, one file per worker; a line = trial id, version of the
                        explanation, explanation, checksum; synced

Explained = a valid line with the trial's id and today's version. A full explanation takes the place
of a short one. Equal duplicates are fine, unequal ones of one depth are an error. The session's
records and ids stay what they were. */

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/trial/remedies.h"
#include "datasets/journal/append_file.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Appends to one worker's file; each Append is on the disk when it returns. */
class ExplanationWriter {
 public:
  /** @throws Error(kIo) as JournalWriter. */
  ExplanationWriter(const std::filesystem::path& folder, int worker, const std::string& label = "");
  void Append(const std::string& trial_id, const Explanation& explanation);

 private:
  AppendFile file_;
};

using Explanations = std::map<std::string, Explanation>;  ///< by trial id

/** Those in a session's folder; none for a session that stands in no folder. Damaged lines count as
not there; `graspbench verify` names them. @throws Error(kFormat) for unequal duplicates,
Error(kIo). */
Explanations LoadExplanations(const std::filesystem::path& folder);

/** Which failures. */
enum class ExplainScope {
  kShortly,  ///< one of each condition, in kMostShortly conditions at most; a short explanation is
             ///< enough
  kOneOfEach,  ///< of a condition
  kAll
};
inline constexpr size_t kMostShortly = 20;

/** Failures that can be explained and are not yet, in the plan's order: those with a mechanism and
without a controller. Of each hand, object, grasp and condition the first one, unless one is
explained, or all. */
std::vector<PlannedTrial> FindUnexplained(const Session& session, ExplainScope scope);

/** Appends what `folder` lacks of the explanations in `other`. @throws as LoadExplanations. */
void MergeExplanations(const std::filesystem::path& folder, const std::filesystem::path& other);

}  // namespace graspbench
