#pragma once
/** @file
Checks, re-simulates and ranks the entries of a benchmark.

A work folder lies beside the page. There, an entry's trials are re-simulated once, in sessions
named by the pack's SHA-256 and the program's build. A stopped session is continued:

    WORK/<pack>-<build>/public/     on the benchmark's draws
    WORK/<pack>-<build>/seed-7/     on held-out draws

Breaking loads and grip thresholds, if requested, are determined in these sessions, on the draws
used for ranking.

No command of an entry is run: controllers replay their recorded actions, so they have no actions
for held-out draws. */

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "datasets/benchmark/board.h"
#include "workbench/experiments/observer.h"
#include "workbench/experiments/pool/batch_runner.h"

namespace graspbench {

struct BoardRequest {
  Benchmark benchmark;
  std::vector<std::filesystem::path> packs;
  std::filesystem::path work;
  std::optional<int> held_out_seed;
  std::string nonce;             ///< of the commitment
  std::string commitment;        ///< published commitment; empty: the benchmark's
  bool with_judge = false;       ///< break held grasps: some five times the cost
  bool with_thresholds = false;  ///< grip thresholds, not for recorded actions: six times the cost
  int num_workers = 1;
  double trial_time_limit = kTrialTimeLimit;  ///< [s of processor time]
};

/** Problems of an entry are reported in Board::refused.
@throws Error(kUsage) when seed and nonce do not match the commitment; Error(kVersion) when the
benchmark needs another version of the program; Error(kInterrupted) when stopped. */
Board RunBoard(const BoardRequest& request, Observer& observer);

}  // namespace graspbench
