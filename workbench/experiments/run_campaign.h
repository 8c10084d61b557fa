#pragma once
/** @file
Runs a campaign: optimises every scene, runs all variants on the same sampled poses, judges held
grasps, and compares search methods. Also merges campaigns from several machines. */

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "datasets/campaign/campaign_store.h"
#include "datasets/shards/shard.h"
#include "workbench/experiments/observer.h"
#include "workbench/experiments/scene_runner.h"

namespace graspbench {

/** A scene, or one search of a comparison; runs on a single thread. */
struct LearningTask {
  std::string hand, object, grasp;  ///< shown while it runs
  int num_trials = 0;               ///< upper bound
  /** Called once, in a worker's thread. */
  std::function<void(TrialPool& pool, const ObserveLearning& observe)> run;
};

/** A shard's part of a round of searches, with the tasks left. */
struct SearchRound {
  StageKind stage = StageKind::kOptimisation;
  int num_all = 0;
  std::vector<LearningTask> left;  ///< refer to the arguments that the round was made from
};
SearchRound ListOptimisations(const std::vector<CampaignScene>& scenes, const Shard& shard = {});
SearchRound ListComparisons(const std::vector<ComparisonTask>& searches, const Shard& shard = {});
/** Runs the remaining tasks in order, until all are done or the observer requests a stop. The
number of trials shown to the observer decreases when a task needs fewer than announced.
@param trial_time_limit  see TrialPool.
@returns the number of finished tasks. @throws as RunTasks of worker_pool.h. */
int RunSearches(const SearchRound& round, int num_workers, Observer& observer,
                double trial_time_limit);

struct CampaignRequest {
  std::filesystem::path folder;
  /** Unset: that of the campaign in `folder`, with its copies of hands and objects
  (session_inputs.h). If set, hands and objects are checked for changes. */
  std::optional<CampaignConfig> config;
  int num_workers = 1;
  double trial_time_limit = kTrialTimeLimit;
  /** Trials of real hands (real_trials.h) that replace the stored ones; empty: none. */
  std::filesystem::path real;
};

/** Creates the folders of a campaign and its scenes, with copies of the user's own inputs, or finds
them; runs nothing. @returns the number of scenes. @throws as RunCampaign. */
int PlanCampaign(const CampaignRequest& request);

/** Plans the benchmark of a campaign if all of its scenes are finished. @returns the number of
unfinished scenes. @throws as RunCampaign. */
int PlanBenchmark(const std::filesystem::path& folder);

/** Starts or continues a campaign. Stages: optimisation, benchmark, judge and, when searches are
compared, comparison.
@returns whether it is finished; otherwise it was stopped, and all finished trials are kept.
@throws Error(kFormat) for real trials that cannot be read, before anything runs; Error(kUsage) for
a folder with another campaign; what LoadSessionInputs and the stores
throw. */
bool RunCampaign(const CampaignRequest& request, Observer& observer);

/** Unfinished parts of a campaign; each part starts when the one before is finished. */
struct CampaignRest {
  int scenes = 0, trials = 0, judgements = 0, searches = 0;
  int sum() const { return scenes + trials + judgements + searches; }
};

/** Merges the shards of a campaign from one or several folders: scenes, searches, and the
benchmark, which is planned when all scenes are finished. Writes the benchmark's exports when it is
finished and judged. @throws as MergeCampaigns, MergeSessions. */
CampaignRest MergeCampaign(const std::filesystem::path& folder,
                           const std::vector<std::filesystem::path>& others);

/** Sentences about machines whose results disagree or were not compared, in any part of the
campaign. */
std::vector<std::string> DescribeCampaignMachines(const std::filesystem::path& folder);

}  // namespace graspbench
