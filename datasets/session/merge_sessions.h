#pragma once
/** @file
The journals of one session from several folders, where machines share no disk. */

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/session/session_store.h"

namespace graspbench {

/** Appends what the session in `folder` lacks of those in `others`: records, judgements,
explanations, lines of workers, to journal/merged-0.jsonl and its like. No file of a worker is
touched, so that the order of merging does not matter and a second time changes nothing. All but
explanations is checked before a byte is written. @returns the number of records that were new.
@throws Error(kUsage) for a session of other settings, plan, physics or schema, with both hashes;
Error(kFormat) for damage, and naming each trial of which two folders have different results;
as LoadSession; Error(kIo). */
int MergeSessions(const std::filesystem::path& folder,
                  const std::vector<std::filesystem::path>& others);

}  // namespace graspbench
