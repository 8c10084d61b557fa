#pragma once
/** @file
Checks that hashes and checksums of a store cannot make: intact lines may belong to another session,
contradict each other, or be unreadable for this program. */

#include <filesystem>

#include "core/base/error.h"
#include "datasets/journal/sealed_store.h"

namespace graspbench {

/** Adds to `state` the damage of session records and search answers in the folder and in its
stores. Does nothing if `state` has damage already.
@param state  result of CheckStore for the folder. @returns warnings about journal lines.
@throws Error as LoadSession, except for damage. */
Diagnostics CheckRecords(const std::filesystem::path& folder, StoreState& state);

}  // namespace graspbench
