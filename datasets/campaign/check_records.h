#pragma once
/** @file
What the hashes and checksums of a store cannot tell: lines that are all as they were written may
belong to another session or contradict each other, or be no answer that this program can read. */

#include <filesystem>

#include "core/base/error.h"
#include "datasets/journal/sealed_store.h"

namespace graspbench {

/** Adds to `state`, what CheckStore has found in the folder, what is wrong with the records of a
session and the answers of a search there or in a store of it; nothing where there is damage
already. @returns what else the journals say of their lines.
@throws Error as LoadSession, but for damage. */
Diagnostics CheckRecords(const std::filesystem::path& folder, StoreState& state);

}  // namespace graspbench
