#pragma once
/** @file
Merges the journals of one session from several folders, for machines without a shared disk. */

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/session/session_store.h"

namespace graspbench {

/** Appends the records, judgements, explanations and workers' lines in `others` that the session in
`folder` lacks, to journal/merged-0.jsonl and similar files. Workers' own files are not changed, so
the order of merging does not matter and merging twice changes nothing. Everything but explanations
is checked before anything is written. @returns the number of new records.
@throws Error(kUsage) for other settings, plan, physics or schema, with both hashes; Error(kFormat)
for damage, and naming each trial with different results in two folders; as LoadSession;
Error(kIo). */
int MergeSessions(const std::filesystem::path& folder,
                  const std::vector<std::filesystem::path>& others);

}  // namespace graspbench
