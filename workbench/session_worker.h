#pragma once
/** @file
Connects the batch to the simulation and the store: a worker simulates the planned trials of a
session and writes them into its own journal. */

#include <filesystem>

#include "datasets/session_config.h"
#include "datasets/session_inputs.h"
#include "workbench/batch_runner.h"

namespace graspbench {

/** @pre config, inputs and folder outlive the workers, and the plan was made from them. */
MakeBatchWorker MakeSessionWorkers(const SessionConfig& config, const SessionInputs& inputs,
                                   const std::filesystem::path& folder);

}  // namespace graspbench
