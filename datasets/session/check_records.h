#pragma once
/** @file
What the hashes and checksums of a store cannot tell: lines that are all as they were written may
belong to another session or contradict each other. */

#include <filesystem>

#include "core/base/diagnostics.h"
#include "datasets/journal/sealed_store.h"

namespace graspbench {

/** Adds to `state`, what CheckStore has found in the folder, what is wrong with the records of a
session there or in a store of it; nothing where there is damage already.
@returns what else the session says of its lines. @throws Error as LoadSession, but for damage. */
Diagnostics CheckRecords(const std::filesystem::path& folder, StoreState& state);

}  // namespace graspbench
