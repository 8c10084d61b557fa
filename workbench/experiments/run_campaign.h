#pragma once
/** @file
A campaign from its configuration to its last search: optimise every scene, try all variants on the
same trial poses, judge what was held, compare search methods. */

#include <atomic>
#include <filesystem>
#include <optional>

#include "datasets/campaign/campaign_store.h"
#include "datasets/shards/shard.h"
#include "workbench/experiments/observer.h"
#include "workbench/experiments/pool/learning_batch.h"

namespace graspbench {

/** A round of searches as far as it is a shard's: what is left of it. */
struct SearchRound {
  StageKind stage = StageKind::kOptimisation;
  int num_all = 0;
  std::vector<LearningTask> left;  ///< refer to what the round was made of
};
SearchRound ListOptimisations(const std::vector<CampaignScene>& scenes, const Shard& shard = {});
SearchRound ListComparisons(const std::vector<ComparisonTask>& searches, const Shard& shard = {});
/** Runs what is left. @returns how many of it are finished. @throws as RunLearningBatch. */
int RunSearches(const SearchRound& round, int num_workers, Observer& observer,
                const std::atomic<bool>& stop, double trial_time_limit);

struct CampaignRequest {
  std::filesystem::path folder;
  /** None: that of the campaign in `folder`, with its copies of hands and objects
  (input_copies.h). Whoever names them again asks whether they are still the same. */
  std::optional<CampaignConfig> config;
  int num_workers = 1;
  double trial_time_limit = kTrialTimeLimit;
  /** A laboratory's trials (real_trials.h), in the place of those that are kept; empty: none. */
  std::filesystem::path real;
};

/** Makes the folder of a campaign with copies of the user's own inputs, and those of its scenes, or
finds them; nothing runs. @returns the number of scenes. @throws as RunCampaign. */
int PlanCampaign(const CampaignRequest& request);

/** Plans the benchmark of a campaign as soon as all of its scenes are finished.
@returns how many are not. @throws as RunCampaign. */
int PlanBenchmark(const std::filesystem::path& folder);

/** Starts or continues a campaign. Stages: optimisation, benchmark, judge and, when searches are
compared, comparison.
@returns whether it is finished; else `stop` was set and all finished trials are kept.
@throws Error(kFormat) for real trials that cannot be read, before anything runs; Error(kUsage) for
a folder with another campaign; what LoadSessionInputs and the stores
throw. */
bool RunCampaign(const CampaignRequest& request, Observer& observer, const std::atomic<bool>& stop);

}  // namespace graspbench
