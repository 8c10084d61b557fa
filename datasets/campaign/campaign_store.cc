#include "datasets/campaign/campaign_store.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/config.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "datasets/plan/frozen_folder.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

fs::path FindComparisonFolder(const fs::path& folder, const std::string& hand,
                              const std::string& object) {
  return folder / "comparison" / (hand + "-" + object);
}

/** Fills evaluations_to_90 of the runs of one scene. */
void CountEvaluations(const std::vector<ComparisonRun*>& runs) {
  double best = -std::numeric_limits<double>::infinity();
  for (const ComparisonRun* run : runs) {
    for (const double fitness : run->fitness) best = std::max(best, fitness);
  }
  for (ComparisonRun* run : runs) {
    if (run->fitness.empty()) continue;
    const double goal = run->fitness.front() + 0.9 * (best - run->fitness.front());
    const auto reached = std::find_if(run->fitness.begin(), run->fitness.end(),
                                      [&](double fitness) { return fitness >= goal; });
    if (reached != run->fitness.end()) {
      run->evaluations_to_90 = static_cast<int>(reached - run->fitness.begin()) + 1;
    }
  }
}

/** The journals of the comparison, in the order of the configuration. */
std::vector<ComparisonRun> LoadComparison(const fs::path& folder, const CampaignConfig& config,
                                          OnDamage on_damage) {
  std::vector<ComparisonRun> runs;
  for (const std::string& scene : config.comparison.scenes) {
    const std::string hand = scene.substr(0, scene.find('/'));
    const std::string object = scene.substr(scene.find('/') + 1);
    for (const std::string& method : config.comparison.methods) {
      for (int seed = 1; seed <= config.comparison.seeds; ++seed) {
        const fs::path path = FindComparisonFolder(folder, hand, object) /
                              (method + "-" + std::to_string(seed) + ".jsonl");
        Diagnostics findings;
        std::vector<Damage> damage;
        ComparisonRun run{hand, object, method, seed, {}, 0};
        for (const auto& record : LoadAnswers<EvaluationRecord>(path, findings, damage)) {
          run.fitness.push_back(record.individual.fitness);
        }
        RefuseAnswers(path.parent_path(), damage, on_damage);
        if (!run.fitness.empty()) runs.push_back(std::move(run));
      }
    }
  }
  std::map<std::string, std::vector<ComparisonRun*>> by_scene;
  for (ComparisonRun& run : runs) by_scene[run.hand + "/" + run.object].push_back(&run);
  for (const auto& [scene, of_scene] : by_scene) CountEvaluations(of_scene);
  return runs;
}

CampaignConfig ParseConfig(const fs::path& folder, Frozen frozen) {
  CompleteOptimiseConfig(frozen.config);
  Diagnostics problems;
  const auto config = ConfigFromJson<CampaignConfig>(
      frozen.config, (folder / kCampaignStore.file).string(), problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the frozen configuration cannot be read");
  return config;
}

/** Configuration and damage; nothing else is loaded. */
Campaign LoadFrozenCampaign(const fs::path& folder, OnDamage on_damage = OnDamage::kRefuse) {
  Frozen frozen = LoadFrozen(kCampaignStore, folder, on_damage);
  Campaign campaign;
  campaign.config = ParseConfig(folder, frozen);
  campaign.damage = std::move(frozen.damage);
  return campaign;
}

std::string HashScenes(const std::vector<CampaignScene>& scenes) {
  std::string hashes;
  for (const CampaignScene& scene : scenes) hashes += CalcInputsHash(scene.inputs);
  return CalcHashHex(hashes);
}

}  // namespace

CampaignConfig LoadCampaignConfig(const fs::path& folder) {
  return ParseConfig(folder,
                     LoadFrozen(kCampaignStore, folder, OnDamage::kRefuse, {kCampaignStore.file}));
}

void CheckCampaignConfig(const CampaignConfig& config) {
  std::string text;
  const auto add = [&](const std::string& where, const std::vector<ConfigProblem>& problems) {
    for (const ConfigProblem& problem : problems) {
      text += "\n" + where + "." + problem.key + ": " + problem.text;
    }
  };
  add("session", Validate(config.session));
  if (config.session.grasps != std::vector<std::string>{"best"}) {
    add("session",
        {{"grasps", "a campaign optimises each object's best grasp; expected \"best\""}});
  }
  add("optimise", Validate(config.optimise));
  if (config.optimise.step != "both") {
    add("optimise",
        {{"step",
          "a campaign compares three variants of a grasp and takes both steps for them; "
          "expected \"both\"; one step alone: graspbench optimise --hand H --object O "
          "--step N, scene by scene"}});
  }
  OptimiseConfig search;  // all else is checked above
  search.evaluations = config.comparison.evaluations;
  search.fitness_trials = config.comparison.fitness_trials;
  search.seed = config.comparison.seeds;
  for (const std::string& method : config.comparison.methods) {
    search.method = method;
    add("comparison", Validate(search));
  }
  if (config.comparison.seeds < 1) add("comparison", {{"seeds", "expected 1 or more"}});
  for (const std::string& scene : config.comparison.scenes) {
    if (scene.find('/') != std::string::npos) continue;
    add("comparison", {{"scenes", "\"" + scene + "\": expected hand/object"}});
  }
  if (!text.empty()) throw Error(ErrorKind::kRange, "the campaign cannot be run" + text);
}

bool HasCampaign(const fs::path& folder) { return HasFrozen(kCampaignStore, folder); }

void CreateCampaign(const fs::path& folder, const CampaignConfig& config) {
  if (HasCampaign(folder)) {
    const std::string text =
        ListDifferences(FindConfigDifferences(LoadFrozenCampaign(folder).config, config));
    if (text.empty()) return;
    throw Error(ErrorKind::kUsage,
                "the campaign was started with other settings (there and now):" + text +
                    "\ncontinue it without them, or choose another folder with --out");
  }
  MakeFolder(folder);
  WriteFrozen(kCampaignStore, folder, ConfigToJson(config));
}

std::vector<CampaignScene> PlanScenes(const CampaignConfig& config, const SessionInputs& inputs,
                                      const fs::path& folder) {
  SessionConfig one_trial = config.session;
  one_trial.trials = 1;
  std::vector<CampaignScene> scenes;
  for (const PlannedTrial& planned : MakePlan(one_trial, inputs)) {
    const TrialSetup setup = MakeTrialSetup(one_trial, inputs, planned);
    CampaignScene scene;
    scene.config.hand = planned.hand;
    scene.config.object = planned.object;
    scene.config.grasp = planned.grasp;
    scene.config.optimise = config.optimise;
    static_cast<TrialConditions&>(scene.config) = config.session;
    scene.inputs = {setup.hand, setup.object, setup.grasp};
    scene.folder = folder / "scenes" / (planned.hand + "-" + planned.object);
    const auto same = std::find_if(scenes.begin(), scenes.end(), [&](const CampaignScene& other) {
      return other.folder == scene.folder;
    });
    if (same != scenes.end()) {
      throw Error(ErrorKind::kUsage,
                  "the scenes " + same->config.hand + ", " + same->config.object + " and " +
                      planned.hand + ", " + planned.object + " come to the same folder " +
                      scene.folder.filename().string() + "; rename a hand or an object");
    }
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

size_t FindSceneNumber(const std::vector<CampaignScene>& scenes, const CampaignScene& scene) {
  return static_cast<size_t>(
      std::count_if(scenes.begin(), scenes.end(),
                    [&](const CampaignScene& other) { return other.folder < scene.folder; }));
}

std::vector<fs::path> ListScenes(const fs::path& folder) {
  std::vector<fs::path> scenes;
  std::error_code status;
  for (const auto& entry : fs::directory_iterator(folder / "scenes", status)) {
    if (HasScene(entry.path())) scenes.push_back(entry.path());
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

void SealScenes(const fs::path& folder, const std::vector<CampaignScene>& scenes) {
  SealStore(kCampaignStore, folder, HashScenes(scenes));
}

void CheckSameScenes(const fs::path& folder, const std::vector<CampaignScene>& scenes) {
  const std::string planned = LoadManifest(folder).inputs, now = HashScenes(scenes);
  if (planned.empty() || planned == now) return;
  throw Error(ErrorKind::kVersion,
              "the hands, objects and grasps of the campaign in \"" + folder.string() + "\" are " +
                  planned + " in its plan and " + now +
                  " to this program: one of them differs from those of the machine that planned "
                  "it");
}

SessionInputs AddSceneGrasps(SessionInputs inputs, const std::vector<CampaignScene>& scenes) {
  for (const CampaignScene& scene : scenes) {
    for (SessionHand& hand : inputs.hands) {
      if (hand.hand != scene.inputs.hand) continue;
      for (const Variant variant : kNewVariants) {
        hand.grasps.push_back(LoadSceneGrasp(scene.folder, variant, *hand.hand));
      }
    }
  }
  return inputs;
}

SessionConfig MakeBenchmarkConfig(const CampaignConfig& config) {
  SessionConfig benchmark = config.session;
  benchmark.grasps = {"best"};
  for (const Variant variant : kNewVariants) benchmark.grasps.push_back(NameOf(variant));
  return benchmark;
}

std::vector<ComparisonTask> PlanComparison(const CampaignConfig& config,
                                           const std::vector<CampaignScene>& scenes,
                                           const fs::path& folder) {
  std::vector<ComparisonTask> tasks;
  std::vector<std::string> known;
  for (const CampaignScene& scene : scenes) {
    known.push_back(scene.config.hand + "/" + scene.config.object);
  }
  for (const std::string& name : config.comparison.scenes) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
      throw Error(ErrorKind::kNotFound, "the campaign has no scene \"" + name + "\" to compare" +
                                            SuggestNames(name, known));
    }
    const CampaignScene& scene = scenes[static_cast<size_t>(found - known.begin())];
    const SceneInputs& inputs = scene.inputs;
    const int num_coordinates =
        MakeGraspSpace(config.optimise.search, {*inputs.hand, *inputs.object, inputs.grasp})
            ->box()
            .size();
    for (const std::string& method : config.comparison.methods) {
      const bool is_grid = method == "grid";
      if (is_grid && num_coordinates > 3) continue;
      for (int seed = 1; seed <= (is_grid ? 1 : config.comparison.seeds); ++seed) {
        ComparisonTask task;
        task.scene = &scene;
        task.config = scene.config;
        task.config.optimise.step = "2";
        task.config.optimise.method = method;
        task.config.optimise.seed = seed;
        task.config.optimise.evaluations = config.comparison.evaluations;
        task.config.optimise.fitness_trials = config.comparison.fitness_trials;
        task.journal = FindComparisonFolder(folder, scene.config.hand, scene.config.object) /
                       (method + "-" + std::to_string(seed) + ".jsonl");
        tasks.push_back(std::move(task));
      }
    }
  }
  return tasks;
}

Campaign LoadCampaign(const fs::path& folder, OnDamage on_damage) {
  Campaign campaign = LoadFrozenCampaign(folder, on_damage);
  for (const fs::path& scene : ListScenes(folder))
    campaign.scenes.push_back(LoadScene(scene, on_damage));
  if (HasSession(folder / "benchmark")) {
    campaign.benchmark = LoadSession(folder / "benchmark", on_damage);
  }
  campaign.comparison = LoadComparison(folder, campaign.config, on_damage);
  campaign.real = LoadRealTrials(folder);
  if (campaign.real.empty()) {
    std::vector<RealScene> scenes;
    for (const SceneRecord& scene : campaign.scenes) {
      scenes.emplace_back(scene.config.hand, scene.config.object);
    }
    campaign.real = LoadPublishedTrials(scenes);
  }
  return campaign;
}

}  // namespace graspbench
