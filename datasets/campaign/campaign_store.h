#pragma once
/** @file
A campaign: every scene (a hand, an object, its best standard grasp) is optimised, then the standard
grasp, the new pre-grasp and the new target grasp are run on the same object poses. Optionally,
search methods are compared over several seeds. Its folder:

    campaign.json                       frozen configuration, schema and program version
    manifest.json                       hashes of files outside scenes and benchmark
    scenes/<hand>-<object>/             one optimised scene each, see scene_store.h
    benchmark/                          a session (session_store.h) of all three variants, judged;
                                        grasps: the standard one, "new-pregrasp", "new-target"
    comparison/<hand>-<object>/<method>-<seed>.jsonl
                                        one search each, an evaluation journal; all start from the
                                        scene's new pre-grasp
    summary.csv                         one row per scene and variant, of the benchmark's trials
    comparison.csv                      one row per search: best fitness, evaluations to 90 %
    real/trials.csv                     a laboratory's own trials (real_trials.h), if any

As for sessions, the bytes are the same for any number of workers and interruptions, except run.json
and the benchmark's journals of the workers. */

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "datasets/campaign/real_trials.h"
#include "datasets/scene/scene_store.h"
#include "datasets/session/session_progress.h"
#include "datasets/session/session_store.h"

namespace graspbench {

struct ComparisonConfig {
  std::vector<std::string> scenes;  ///< "tum/adhesive_tape"; empty: no comparison
  std::vector<std::string> methods = {"es", "cmaes", "de", "random"};
  int seeds = 10;
  int evaluations = 300;
  int fitness_trials = 1;

  template <class V>
  void Visit(V&& v) {
    v("scenes", scenes, "hand/object pairs on which search methods are compared; empty: none");
    v("methods", methods, "search methods that are compared");
    v("seeds", seeds, "searches of each method and scene");
    v("evaluations", evaluations, "grasps that each search tries");
    v("fitness_trials", fitness_trials, "trials of an evaluation; 1: without variation");
  }
};

/** As a session, but with automatic approach, nominal positioning and the other defaults of keys
that a campaign does not have. */
struct CampaignSession : SessionConfig {
  template <class V>
  void Visit(V&& v) {
    VisitOwn(v);
  }
};

struct CampaignConfig {
  /** Uses a fifth of the evaluations of a single scene, since 42 scenes take 42 times as long. */
  CampaignConfig() { optimise.evaluations /= 5; }

  CampaignSession session;  ///< hands, objects, and the benchmark's trials; grasps is "best"
  OptimiseConfig optimise;
  ComparisonConfig comparison;

  template <class V>
  void Visit(V&& v) {
    v("session", session);
    v("optimise", optimise);
    v("comparison", comparison);
  }
};

/** @throws Error(kRange) listing all problems of the values. */
void CheckCampaignConfig(const CampaignConfig& config);

/** Loads the frozen configuration; reads no other file. @throws Error(kNotFound, kVersion,
kFormat). */
CampaignConfig LoadCampaignConfig(const std::filesystem::path& folder);

bool HasCampaign(const std::filesystem::path& folder);
/** Creates the folder, or accepts the same campaign there.
@throws Error(kUsage) listing the settings that differ; kVersion; kFormat; kIo. */
void CreateCampaign(const std::filesystem::path& folder, const CampaignConfig& config);

struct CampaignScene {
  SceneConfig config;
  SceneInputs inputs;
  std::filesystem::path folder;
};
/** Plans the scenes in the order hand, object. @throws as LoadSessionInputs and MakePlan. */
std::vector<CampaignScene> PlanScenes(const CampaignConfig& config, const SessionInputs& inputs,
                                      const std::filesystem::path& folder);

/** Index of a scene, from 0, when all are sorted by folder name. `graspbench status` can find it
without loading a hand. */
size_t FindSceneNumber(const std::vector<CampaignScene>& scenes, const CampaignScene& scene);
/** Lists the folders of the scenes that have begun, by name. */
std::vector<std::filesystem::path> ListScenes(const std::filesystem::path& folder);

/** Seals the campaign with a hash of the scenes' hands, objects and grasps. */
void SealScenes(const std::filesystem::path& folder, const std::vector<CampaignScene>& scenes);
/** @throws Error(kVersion) when other scenes were sealed, with both hashes. */
void CheckSameScenes(const std::filesystem::path& folder, const std::vector<CampaignScene>& scenes);

/** Returns the inputs of the benchmark: `inputs` with the saved grasps of all scenes. @pre all
scenes are finished. */
SessionInputs AddSceneGrasps(SessionInputs inputs, const std::vector<CampaignScene>& scenes);
SessionConfig MakeBenchmarkConfig(const CampaignConfig& config);

/** One search of the comparison. */
struct ComparisonTask {
  const CampaignScene* scene = nullptr;
  SceneConfig config;  ///< the scene's, with the task's method, seed and budget
  std::filesystem::path journal;
};
/** Plans all searches. A grid search is planned once per scene, if it has at most three
coordinates.
@throws Error(kNotFound) for a scene that the campaign does not have. */
std::vector<ComparisonTask> PlanComparison(const CampaignConfig& config,
                                           const std::vector<CampaignScene>& scenes,
                                           const std::filesystem::path& folder);

struct ComparisonRun {
  std::string hand, object, method;
  int seed = 0;
  std::vector<double> fitness;  ///< of each evaluation in order
  /** Evaluations until the best fitness so far reaches 90 % of the gain from the start to the best
  of all runs of the scene; 0: never. */
  int evaluations_to_90 = 0;
};

struct Campaign {
  CampaignConfig config;
  std::vector<SceneRecord> scenes;
  Session benchmark;  ///< empty plan: not begun
  std::vector<ComparisonRun> comparison;
  std::vector<RealTrial> real;  ///< a laboratory's, else the published ones
  std::vector<Damage> damage;   ///< found and accepted
};
/** Loads everything that is stored, finished or not, without hands and objects.
@throws Error(kNotFound, kVersion, kFormat, kIo). */
Campaign LoadCampaign(const std::filesystem::path& folder, OnDamage on_damage = OnDamage::kRefuse);

/** Merges an optimisation from several folders, for machines without a shared disk. Adds to
`folder` what it lacks and `others` have. Since equal questions have equal answers, one journal must
be a prefix of the other; the longer one is taken, with its result if any. Each folder of `others`
is checked before any of it is written.
@returns the number of new answers. @throws Error(kUsage) for other settings or another physics;
Error(kFormat) for damage, and when answers differ; as LoadScene; Error(kIo). */
int MergeScenes(const std::filesystem::path& folder,
                const std::vector<std::filesystem::path>& others);

/** As MergeScenes(), for the scenes, the compared searches and the workers' lines of a campaign.
The benchmark, a session, is merged separately (merge_sessions.h). */
int MergeCampaigns(const std::filesystem::path& folder,
                   const std::vector<std::filesystem::path>& others);

/** Progress of a campaign, from its folders and journals alone, without loading hands or
objects. */
struct CampaignProgress {
  int num_scenes = 0;
  int num_finished = 0;
  std::vector<ShardProgress> shards;  ///< by scenes, for every number of shards with a worker
  std::set<std::string> unchecked;    ///< see SessionProgress
  std::vector<Damage> damages;        ///< see SessionProgress
  int num_searches = 0;               ///< of the comparison, begun
  std::optional<SessionProgress> benchmark;  ///< none: not planned yet
};

/** @param stale_after  as in ReadProgress. @throws as LoadCampaignConfig; Error(kIo). */
CampaignProgress ReadCampaignProgress(const std::filesystem::path& folder, double stale_after,
                                      IndexUse index_use = IndexUse::kBelieve);

/** Progress of a search with one journal, such as an optimisation or a hand's development. */
struct SearchProgress {
  bool is_finished = false;
  int num_answers = 0;
  int num_bad_lines = 0;
  std::vector<Damage> damages;  ///< see SessionProgress
  std::optional<double> age;    ///< since its journal was last written [s]; none: not begun
};
SearchProgress ReadSearchProgress(const std::filesystem::path& folder);

}  // namespace graspbench
