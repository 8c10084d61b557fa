#pragma once
/** @file
Entries of a benchmark checked, simulated again and ranked.

Beside the page stands a folder of work. An entry's trials are simulated again there once, in
sessions named by the pack's SHA-256 and the program's build, which stopping and starting continues:

    WORK/<pack>-<build>/public/     on the benchmark's draws
    WORK/<pack>-<build>/seed-7/     on held-out draws

What is asked for beside success, breaking loads and grip thresholds, is found in them, on the draws
that rank.

No command of an entry is run: a controller repeats its recorded actions, so on held-out draws,
which it has not met, it has none. */

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
  std::string commitment;        ///< that was published; empty: the benchmark's
  bool with_judge = false;       ///< break what is held: some five times as long
  bool with_thresholds = false;  ///< grip thresholds, but of recorded actions: some six times
  int num_workers = 1;
  double trial_time_limit = kTrialTimeLimit;  ///< [s of processor time]
};

/** @throws Error(kUsage) when seed and nonce are not what was committed to; Error(kVersion) when
the program is not the benchmark's; Error(kInterrupted) when stopped. What is wrong with an entry is
in Board::refused. */
Board RunBoard(const BoardRequest& request, Observer& observer);

}  // namespace graspbench
