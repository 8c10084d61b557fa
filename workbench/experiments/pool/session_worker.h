#pragma once
/** @file
Connects the batch to the simulation and the store: a worker simulates the planned trials of a
session and writes them into its own journal. */

#include <filesystem>

#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/session/judgement_store.h"
#include "workbench/experiments/pool/batch_runner.h"
#include "workbench/experiments/pool/setup_runner.h"

namespace graspbench {

/** Simulates planned trials of a session in one thread. */
class PlannedTrialRunner {
 public:
  /** @pre both outlive the runner. */
  PlannedTrialRunner(const SessionConfig& config, const SessionInputs& inputs)
      : config_(config), inputs_(inputs) {}
  void Prepare(const PlannedTrial& planned) {
    runner_.Prepare(MakeTrialSetup(config_, inputs_, planned));
  }
  TrialResult Run(const PlannedTrial& planned) {
    return runner_.Run(MakeTrialSetup(config_, inputs_, planned));
  }
  /** @param interval  of the instants, as TraceTrial. */
  TracedTrial Trace(const PlannedTrial& planned, double interval) {
    return runner_.Trace(MakeTrialSetup(config_, inputs_, planned), interval);
  }
  JudgedTrial Judge(const PlannedTrial& planned) {
    return runner_.Judge(MakeTrialSetup(config_, inputs_, planned));
  }

 private:
  const SessionConfig& config_;
  const SessionInputs& inputs_;
  SetupRunner runner_;
};

/** @param label  of a shard's journals; empty: the session has one process.
@pre session and inputs outlive the workers and belong together. */
MakeBatchWorker MakeSessionWorkers(const Session& session, const SessionInputs& inputs,
                                   const std::filesystem::path& folder, const std::string& label);

/** Workers that run finished trials again, with the judge, and write what it finds.
@pre session and inputs outlive the workers.
@throws (in a worker) Error(kVersion) when a trial gives another result than its record. */
MakeBatchWorker MakeJudgeWorkers(const Session& session, const SessionInputs& inputs,
                                 const std::filesystem::path& folder, const std::string& label);

}  // namespace graspbench
