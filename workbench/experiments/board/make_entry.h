#pragma once
/** @file
Packs a finished session as a benchmark entry. */

#include <filesystem>

#include "datasets/benchmark/entry_pack.h"

namespace graspbench {

struct EntryRequest {
  std::filesystem::path session;
  Benchmark benchmark;
  EntryFacts facts;  ///< except those of the benchmark
  /** New file "NAME.tar", or a folder "DIR" for "DIR/DIR.tar", as for a pipeline stage. */
  std::filesystem::path out;
};

/** Writes the pack. @returns its path. @throws Error(kUsage) when the pack exists or the session
cannot be an entry, saying why; as LoadSession, CheckEntry, GatherEntry. */
std::filesystem::path MakeEntry(const EntryRequest& request);

}  // namespace graspbench
