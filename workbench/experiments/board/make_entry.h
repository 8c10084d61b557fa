#pragma once
/** @file
A finished session as an entry of a benchmark. */

#include <filesystem>

#include "datasets/benchmark/entry_pack.h"

namespace graspbench {

struct EntryRequest {
  std::filesystem::path session;
  Benchmark benchmark;
  EntryFacts facts;  ///< but the benchmark's
  std::filesystem::path pack;
};

/** Writes the pack. @throws Error(kUsage) when the pack exists or the session cannot be an entry,
saying why; as LoadSession, CheckEntry, GatherEntry. */
void MakeEntry(const EntryRequest& request);

}  // namespace graspbench
