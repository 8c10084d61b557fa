#pragma once
/** @file
A campaign from its configuration to its last search: optimise every scene, try all variants on the
same trial poses, judge what was held, compare search methods. */

#include <atomic>
#include <filesystem>

#include "datasets/campaign/campaign_store.h"
#include "workbench/experiments/observer.h"

namespace graspbench {

/** Starts or continues the campaign in `folder`. Stages: "optimisation", "benchmark", "judge" and,
when searches are compared, "comparison".
@returns whether it is finished; else `stop` was set and all finished trials are kept.
@throws Error(kUsage) for a folder with another campaign; what LoadSessionInputs and the stores
throw. */
bool RunCampaign(const std::filesystem::path& folder, const CampaignConfig& config, int num_workers,
                 Observer& observer, const std::atomic<bool>& stop);

}  // namespace graspbench
