#pragma once
/** @file
Explanations of a session's failures (core/trial/remedies.h), in its folder:

    explain/<n>.jsonl   append-only, one file per worker; a line = trial id, version of the
                        explanation, explanation, checksum; synced

A trial is explained if there is a valid line with its id and the current version. A full
explanation replaces a short one. Equal duplicates are accepted; unequal ones of the same depth are
an error. The session's records and ids do not change. */

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/trial/remedies.h"
#include "datasets/journal/append_file.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Appends to one worker's file; a line is on disk when Append returns. */
class ExplanationWriter {
 public:
  /** @throws Error(kIo) as JournalWriter. */
  ExplanationWriter(const std::filesystem::path& folder, int worker, const std::string& label = "");
  void Append(const std::string& trial_id, const Explanation& explanation);

 private:
  AppendFile file_;
};

using Explanations = std::map<std::string, Explanation>;  ///< by trial id

/** Loads the explanations in a session's folder; none for a session without a folder. Skips damaged
lines, which `graspbench verify` reports. @throws Error(kFormat) for unequal duplicates;
Error(kIo). */
Explanations LoadExplanations(const std::filesystem::path& folder);

/** Which failures to explain. "Condition" here means hand, object, grasp and session condition. */
enum class ExplainScope {
  kShortly,    ///< one per condition, at most kMostShortly conditions; a short explanation
               ///< suffices
  kOneOfEach,  ///< one per condition
  kAll
};
inline constexpr size_t kMostShortly = 20;

/** Lists failures without an explanation that can have one (a mechanism and no controller), in the
plan's order. Depending on `scope`, lists all, or the first of each condition without an explained
failure. */
std::vector<PlannedTrial> FindUnexplained(const Session& session, ExplainScope scope);

/** Appends the explanations in `other` that `folder` lacks. @throws as LoadExplanations. */
void MergeExplanations(const std::filesystem::path& folder, const std::filesystem::path& other);

}  // namespace graspbench
