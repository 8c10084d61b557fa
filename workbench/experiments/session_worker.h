#pragma once
/** @file
Connects the batch to the simulation and the store: a worker simulates the planned trials of a
session and writes them into its own journal. */

#include <filesystem>
#include <memory>

#include "core/trial/trial_runner.h"
#include "datasets/session/judgement_store.h"
#include "datasets/session/session_config.h"
#include "datasets/session/session_inputs.h"
#include "workbench/experiments/batch_runner.h"

namespace graspbench {

/** Simulates planned trials of a session in one thread. */
class PlannedTrialRunner {
 public:
  /** @pre both outlive the runner. */
  PlannedTrialRunner(const SessionConfig& config, const SessionInputs& inputs)
      : config_(config), inputs_(inputs) {}
  TrialResult Run(const PlannedTrial& planned);
  JudgedTrial Judge(const PlannedTrial& planned);

 private:
  TrialRunner& FindRunner(const TrialSetup& setup);

  const SessionConfig& config_;
  const SessionInputs& inputs_;
  // Of the last hand and object: a plan has all trials of a pair in a row.
  std::shared_ptr<const Hand> hand_;
  std::shared_ptr<const GraspObject> object_;
  std::unique_ptr<TrialRunner> runner_;
};

/** @pre config, inputs and folder outlive the workers, and the plan was made from them. */
MakeBatchWorker MakeSessionWorkers(const SessionConfig& config, const SessionInputs& inputs,
                                   const std::filesystem::path& folder);

/** Workers that run finished trials again, with the judge, and write what it finds.
@pre session and inputs outlive the workers.
@throws (in a worker) Error(kVersion) when a trial gives another result than its record. */
MakeBatchWorker MakeJudgeWorkers(const Session& session, const SessionInputs& inputs,
                                 const std::filesystem::path& folder);

}  // namespace graspbench
