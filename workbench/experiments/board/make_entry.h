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
  /** New file "NAME.tar", or a folder "DIR" for "DIR/DIR.tar", as a stage of a pipeline has one. */
  std::filesystem::path out;
};

/** @returns the pack that it wrote. @throws Error(kUsage) when the pack exists or the session
cannot be an entry, saying why; as LoadSession, CheckEntry, GatherEntry. */
std::filesystem::path MakeEntry(const EntryRequest& request);

}  // namespace graspbench
