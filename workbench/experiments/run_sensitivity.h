#pragma once
/** @file
The finished trials of a session again, on the same draws, under one changed setting after the
other (datasets/session/sensitivity_store.h). */

#include <filesystem>
#include <string>
#include <vector>

#include "workbench/experiments/session_experiment.h"

namespace graspbench {

/** One or two other values for everything that nobody has measured or that was made up: half and
twice, less for friction, and none at all of the variation; every other coupling rule. What is out
of range or as the session has it is left out. */
std::vector<std::string> ListDefaultVariations(const SessionConfig& config);

struct SensitivityRequest : ExperimentRequest {
  std::vector<std::string> settings;  ///< "sim.step_s=0.001"; empty: ListDefaultVariations
};

/** @throws Error(kUsage, kRange) for a setting that cannot be used or is named twice; as
PrepareExperiment. */
PreparedSession PrepareSensitivity(const SensitivityRequest& request);

}  // namespace graspbench
