#pragma once
/** @file
A campaign from its configuration to its last search: optimise every scene, try all variants on the
same trial poses, judge what was held, compare search methods; and its merge from several machines.
*/

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

/** A scene or one search of a comparison, which runs on one thread from start to end. */
struct LearningTask {
  std::string hand, object, grasp;  ///< shown while it runs
  int num_trials = 0;               ///< at most
  /** Called once, in a worker's thread. */
  std::function<void(TrialPool& pool, const ObserveLearning& observe)> run;
};

/** A round of searches as far as it is a shard's: what is left of it. */
struct SearchRound {
  StageKind stage = StageKind::kOptimisation;
  int num_all = 0;
  std::vector<LearningTask> left;  ///< refer to what the round was made of
};
SearchRound ListOptimisations(const std::vector<CampaignScene>& scenes, const Shard& shard = {});
SearchRound ListComparisons(const std::vector<ComparisonTask>& searches, const Shard& shard = {});
/** Runs what is left, in its order, until all is done or the observer asks to stop. The number of
trials that the observer is shown falls when a task needs fewer than announced.
@param trial_time_limit  see TrialPool.
@returns how many of it are finished. @throws as RunTasks of worker_pool.h. */
int RunSearches(const SearchRound& round, int num_workers, Observer& observer,
                double trial_time_limit);

struct CampaignRequest {
  std::filesystem::path folder;
  /** None: that of the campaign in `folder`, with its copies of hands and objects
  (session_inputs.h). Whoever names them again asks whether they are still the same. */
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
@returns whether it is finished; else it was stopped and all finished trials are kept.
@throws Error(kFormat) for real trials that cannot be read, before anything runs; Error(kUsage) for
a folder with another campaign; what LoadSessionInputs and the stores
throw. */
bool RunCampaign(const CampaignRequest& request, Observer& observer);

/** What of a campaign is not finished; the next follows when all of one is. */
struct CampaignRest {
  int scenes = 0, trials = 0, judgements = 0, searches = 0;
  int sum() const { return scenes + trials + judgements + searches; }
};

/** Puts a campaign together whose shards were worked on, in one folder or several: merges scenes,
searches and the benchmark, which is planned when all scenes are finished; writes
the benchmark's exports when it is finished and judged. @throws as MergeCampaigns, MergeSessions. */
CampaignRest MergeCampaign(const std::filesystem::path& folder,
                           const std::vector<std::filesystem::path>& others);

/** Machines that disagree or were not asked, in any part of the campaign, as sentences. */
std::vector<std::string> DescribeCampaignMachines(const std::filesystem::path& folder);

}  // namespace graspbench
