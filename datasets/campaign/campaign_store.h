#pragma once
/** @file
A campaign: every scene (a hand, an object, its best standard grasp) is optimised, then the standard
grasp, the new pre-grasp and the new target grasp are tried on the same trial poses; if wanted,
search methods are compared over several seeds. Its folder:

    campaign.json                       frozen configuration, schema and program version
    manifest.json                       hashes of what is not in a scene or the benchmark
    scenes/<hand>-<object>/             one optimised scene each, see scene_store.h
    benchmark/                          a session (session_store.h) of all three variants, judged;
                                        grasps: the standard one, "new-pregrasp", "new-target"
    comparison/<hand>-<object>/<method>-<seed>.jsonl
                                        one search each, an evaluation journal; all start from the
                                        scene's new pre-grasp
    summary.csv                         one row per scene and variant, of the benchmark's trials
    comparison.csv                      one row per search: best fitness, evaluations to 90 %
    real/trials.csv                     a laboratory's own trials (real_trials.h), if any

Same promise as for sessions: the same bytes for any number of workers and interruptions, run.json
and the benchmark's journals of each worker aside. */

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

/** As a session, but that hands come from where objects and grasps say, and blindly. */
struct CampaignSession : SessionConfig {
  template <class V>
  void Visit(V&& v) {
    VisitOwn(v);
  }
};

struct CampaignConfig {
  /** A fifth of the evaluations of one scene alone: 42 scenes take 42 times as long. */
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

/** The frozen configuration; no other file is read. @throws Error(kNotFound, kVersion, kFormat). */
CampaignConfig LoadCampaignConfig(const std::filesystem::path& folder);

bool HasCampaign(const std::filesystem::path& folder);
/** Creates the folder, or finds the same campaign there.
@throws Error(kUsage) listing the settings that differ; kVersion; kFormat; kIo. */
void CreateCampaign(const std::filesystem::path& folder, const CampaignConfig& config);

struct CampaignScene {
  SceneConfig config;
  SceneInputs inputs;
  std::filesystem::path folder;
};
/** The scenes in the order hand, object. @throws as LoadSessionInputs and MakePlan. */
std::vector<CampaignScene> PlanScenes(const CampaignConfig& config, const SessionInputs& inputs,
                                      const std::filesystem::path& folder);

/** Where a scene stands among all of them by the names of their folders, from 0: what status can see
without loading a hand. */
size_t FindSceneNumber(const std::vector<CampaignScene>& scenes, const CampaignScene& scene);
/** The folders of the scenes that are begun, by name. */
std::vector<std::filesystem::path> ListScenes(const std::filesystem::path& folder);

/** Seals the campaign with a hash of the scenes' hands, objects and grasps. */
void SealScenes(const std::filesystem::path& folder, const std::vector<CampaignScene>& scenes);
/** @throws Error(kVersion) when they were sealed with others, saying both hashes. */
void CheckSameScenes(const std::filesystem::path& folder, const std::vector<CampaignScene>& scenes);

/** The inputs of the benchmark: `inputs` and the saved grasps of all scenes, which are finished. */
SessionInputs AddSceneGrasps(SessionInputs inputs, const std::vector<CampaignScene>& scenes);
SessionConfig MakeBenchmarkConfig(const CampaignConfig& config);

/** One search of the comparison. */
struct ComparisonTask {
  const CampaignScene* scene = nullptr;
  SceneConfig config;  ///< that of the scene with the task's method, seed and budget
  std::filesystem::path journal;
};
/** @throws Error(kNotFound) for a scene that the campaign has not. A grid is planned once, and only
where it is possible. */
std::vector<ComparisonTask> PlanComparison(const CampaignConfig& config,
                                           const std::vector<CampaignScene>& scenes,
                                           const std::filesystem::path& folder);

struct ComparisonRun {
  std::string hand, object, method;
  int seed = 0;
  std::vector<double> fitness;  ///< of each evaluation in order
  /** Evaluations until the best so far has made 90 % of the way from the start's fitness to the
  best of all runs of the scene; 0: never. */
  int evaluations_to_90 = 0;
};

struct Campaign {
  CampaignConfig config;
  std::vector<SceneRecord> scenes;
  Session benchmark;  ///< empty plan: not begun
  std::vector<ComparisonRun> comparison;
  std::vector<RealTrial> real;  ///< a laboratory's, or else the published ones
  std::vector<Damage> damage;   ///< found and accepted, that of scenes and benchmark too
};
/** Everything that is stored, finished or not; hands and objects are not loaded.
@throws Error(kNotFound, kVersion, kFormat, kIo). */
Campaign LoadCampaign(const std::filesystem::path& folder, OnDamage on_damage = OnDamage::kRefuse);

/** The parts of one campaign, or of one optimisation, from several folders, where machines share no
disk.

Takes what the optimisation in `folder` lacks of those in `others`. The same questions have the
same answers, so one journal must be the beginning of the other, and the longer one is taken, with
the result when there is one. Nothing is written unless all of it fits.
@returns how many answers were new. @throws Error(kUsage) for one of other settings or another
physics; Error(kFormat) for damage, and when the answers differ; as LoadScene; Error(kIo). */
int MergeScenes(const std::filesystem::path& folder,
                const std::vector<std::filesystem::path>& others);

/** The same for the scenes and the compared searches of a campaign, and lines of its workers. The
benchmark is a session and has its own merge (merge_sessions.h). */
int MergeCampaigns(const std::filesystem::path& folder,
                   const std::vector<std::filesystem::path>& others);

/** How far a campaign, an optimisation or a development is, from its folders and journals alone; no
hand or object is loaded. */
struct CampaignProgress {
  int num_scenes = 0;
  int num_finished = 0;
  std::vector<ShardProgress> shards;  ///< of the scenes; of every number of shards with a worker
  std::set<std::string> unchecked;    ///< see SessionProgress
  std::vector<Damage> damages;        ///< see SessionProgress
  int num_searches = 0;               ///< of the comparison that are begun
  std::optional<SessionProgress> benchmark;  ///< none: it is not planned yet
};

/** @param stale_after  as in ReadProgress. @throws as LoadCampaignConfig; Error(kIo). */
CampaignProgress ReadCampaignProgress(const std::filesystem::path& folder, double stale_after,
                                      IndexUse index_use = IndexUse::kBelieve);

/** A search that keeps one journal, of an optimisation or of a hand's development: its number of
answers. */
struct SearchProgress {
  bool is_finished = false;
  int num_answers = 0;
  int num_bad_lines = 0;
  std::vector<Damage> damages;  ///< see SessionProgress
  std::optional<double> age;    ///< since its journal was written [s]; none: nobody has begun
};
SearchProgress ReadSearchProgress(const std::filesystem::path& folder);

}  // namespace graspbench
