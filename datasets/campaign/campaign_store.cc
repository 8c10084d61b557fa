#include "datasets/campaign/campaign_store.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "datasets/journal/checked_line.h"
#include "datasets/journal/file_lock.h"
#include "datasets/plan/frozen_folder.h"
#include "datasets/shards/worker_log.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

void AddShards(const std::vector<fs::path>& scenes, int num_shards, const Deal& deal,
               double stale_after, std::vector<ShardProgress>& shards) {
  std::vector<ShardProgress> of_deal;
  for (int number = 1; number <= num_shards; ++number) {
    ShardProgress& progress = of_deal.emplace_back();
    progress.shard = {number, num_shards};
    for (size_t i = 0; i < scenes.size(); ++i) {
      if (!IsCardOf(i, progress.shard)) continue;
      ++progress.num_trials;
      progress.num_finished += HasSceneResult(scenes[i]);
      const fs::path journal = scenes[i] / "journal.jsonl";
      if (deal.ages.count(number) == 0 || !fs::exists(journal)) continue;
      progress.age = std::min(CalcAge(journal), progress.age.value_or(CalcAge(journal)));
    }
  }
  CompleteShards(deal, stale_after, of_deal);
  shards.insert(shards.end(), of_deal.begin(), of_deal.end());
}

/** What is to be copied, found before a byte is written. */
struct Copies {
  std::vector<std::pair<fs::path, fs::path>> files;  // from, to; in this order
  int num_answers = 0;
};

/** A journal's whole lines; empty: there is none. */
std::string ReadLines(const fs::path& path) {
  std::error_code status;
  if (!fs::exists(path, status)) return "";
  const std::string text = ReadFile(path);
  return text.substr(0, text.rfind('\n') + 1);  // npos + 1 is 0
}

/** True when the journal there is the longer one. */
bool AddJournal(const fs::path& here, const fs::path& there, Copies& copies) {
  const std::string mine = ReadLines(here), other = ReadLines(there);
  const size_t common = std::min(mine.size(), other.size());
  if (mine.compare(0, common, other, 0, common) != 0) {
    throw Error(ErrorKind::kFormat, "\"" + there.string() + "\" has other answers than \"" +
                                        here.string() +
                                        "\": two machines or versions of the program have worked "
                                        "on it; nothing of the first was merged, leave it or the "
                                        "second out");
  }
  if (other.size() <= mine.size()) return false;
  copies.files.emplace_back(there, here);
  copies.num_answers += static_cast<int>(
      std::count(other.begin() + static_cast<std::ptrdiff_t>(common), other.end(), '\n'));
  return true;
}

void AddScene(const fs::path& here, const fs::path& there, Copies& copies) {
  RemoveLeftOwner(here / "journal.jsonl");  // nobody opens that of a finished scene again
  AddJournal(here / "journal.jsonl", there / "journal.jsonl", copies);
  if (!HasSceneResult(there)) return;
  if (HasSceneResult(here)) {
    if (ReadFile(here / "result.json") == ReadFile(there / "result.json")) return;
    throw Error(ErrorKind::kFormat, "\"" + there.string() + "\" has another result than \"" +
                                        here.string() + "\"; nothing of the first was merged");
  }
  for (const std::string& name : ListMatches(there, kSceneStore.derived)) {
    copies.files.emplace_back(there / name, here / name);
  }
  copies.files.emplace_back(there / kManifestFile, here / kManifestFile);  // last: it is finished
}

/** The program's version may differ. */
void CheckSameStore(const StoreKind& kind, const fs::path& folder, const fs::path& other) {
  VerifyStore(other, OnDamage::kRefuse);
  LoadFrozen(kind, other);
  const auto load = [&kind](const fs::path& of) {
    Json frozen = Json::parse(ReadFile(of / kind.file));
    frozen.erase("program_version");
    const std::optional<Manifest> manifest = FindManifest(of);
    return std::pair(frozen, kind.stores.empty() || !manifest ? "" : manifest->inputs);
  };
  const auto describe = [](const fs::path& of, const std::pair<Json, std::string>& store) {
    return "\n  " + of.string() + ": schema " + FormatJson(store.first.at("schema")) +
           ", physics " + FormatJson(store.first.at("physics_version")) + ", settings " +
           CalcHashHex(FormatJson(store.first.at("config"))) +
           (store.second.empty() ? "" : ", inputs " + store.second);
  };
  const auto here = load(folder), there = load(other);
  if (here == there) return;
  throw Error(ErrorKind::kUsage, "\"" + other.string() + "\" holds another " + kind.name +
                                     " than \"" + folder.string() + "\", nothing was merged:" +
                                     describe(folder, here) + describe(other, there));
}

void Copy(const Copies& copies) {
  for (const auto& [from, to] : copies.files) {
    MakeFolder(to.parent_path());
    WriteFileAtomically(to, to.extension() == ".jsonl" ? ReadLines(from) : ReadFile(from));
  }
}

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

/** Configuration and damage; nothing else is loaded. */
Campaign LoadFrozenCampaign(const fs::path& folder, OnDamage on_damage = OnDamage::kRefuse) {
  Frozen frozen = LoadFrozen(kCampaignStore, folder, on_damage);
  Campaign campaign;
  campaign.config = ParseFrozen<CampaignConfig>(kCampaignStore, folder, frozen.config);
  campaign.damage = std::move(frozen.damage);
  return campaign;
}

std::string HashScenes(const std::vector<CampaignScene>& scenes) {
  std::string hashes;
  for (const CampaignScene& scene : scenes) hashes += CalcInputsHash(scene.inputs);
  return CalcHashHex(hashes);
}

}  // namespace

CampaignProgress ReadCampaignProgress(const fs::path& folder, double stale_after,
                                      IndexUse index_use) {
  LoadCampaignConfig(folder);
  const std::vector<fs::path> scenes = ListScenes(folder);
  CampaignProgress progress;
  progress.num_scenes = static_cast<int>(scenes.size());
  progress.num_finished =
      static_cast<int>(std::count_if(scenes.begin(), scenes.end(), HasSceneResult));
  progress.num_searches = static_cast<int>(ListMatches(folder, {"comparison/*/*.jsonl"}).size());
  progress.damages = FindLostBytes(folder);
  Diagnostics ignored;  // a merge reports them
  const Workers workers = LoadWorkers(folder, ignored);
  progress.unchecked = FindUnchecked(folder, workers.starts);
  constexpr int kMostShards = 100000;  // a file of another origin must not fill the memory
  for (const auto& [num_shards, deal] : FindDeals(folder, "journal", "", workers, kMostShards)) {
    AddShards(scenes, num_shards, deal, stale_after, progress.shards);
  }
  if (HasSession(folder / "benchmark")) {
    progress.benchmark = ReadProgress(folder / "benchmark", stale_after, index_use);
  }
  return progress;
}

SearchProgress ReadSearchProgress(const fs::path& folder) {
  SearchProgress progress;
  const fs::path journal = folder / "journal.jsonl";
  progress.damages = FindLostBytes(folder);
  const Manifest manifest = FindManifest(folder).value_or(Manifest());
  // A result counts when it is sealed.
  progress.is_finished = manifest.Find("result.json") || manifest.Find("grasps.csv") ||
                         manifest.Find("candidates.csv");
  if (!fs::exists(journal)) return progress;
  progress.age = CalcAge(journal);
  ForEachLineOfFile(journal, [&](const FileLine& line) {
    if (!line.is_whole || line.text.empty()) return;
    ++(IsCheckedLine(line.text) ? progress.num_answers : progress.num_bad_lines);
  });
  return progress;
}

int MergeScenes(const fs::path& folder, const std::vector<fs::path>& others) {
  int num_answers = 0;
  VerifyStore(folder, OnDamage::kRefuse);
  for (const fs::path& other : others) CheckSameStore(kSceneStore, folder, other);
  for (const fs::path& other : others) {
    Copies copies;
    AddScene(folder, other, copies);
    Copy(copies);
    num_answers += copies.num_answers;
  }
  return num_answers;
}

int MergeCampaigns(const fs::path& folder, const std::vector<fs::path>& others) {
  int num_answers = 0;
  VerifyStore(folder, OnDamage::kRefuse);
  for (const fs::path& other : others) CheckSameStore(kCampaignStore, folder, other);
  for (const fs::path& other : others) {
    Copies copies;
    for (const fs::path& scene : ListScenes(other)) {
      const fs::path here = folder / scene.lexically_relative(other);
      if (!HasScene(here)) {
        throw Error(ErrorKind::kFormat, "\"" + folder.string() + "\" lacks the scene \"" +
                                            here.filename().string() + "\" of \"" + other.string() +
                                            "\"; nothing of the latter was merged");
      }
      AddScene(here, scene, copies);
    }
    for (const std::string& search : ListMatches(other, {"comparison/*/*.jsonl"})) {
      AddJournal(folder / search, other / search, copies);
    }
    Copy(copies);
    std::set<std::string> known = ListStartLines(folder);
    AppendStarts(folder, CollectStarts(other, known));
    num_answers += copies.num_answers;
  }
  return num_answers;
}

CampaignConfig LoadCampaignConfig(const fs::path& folder) {
  return ParseFrozen<CampaignConfig>(
      kCampaignStore, folder,
      LoadFrozen(kCampaignStore, folder, OnDamage::kRefuse, {kCampaignStore.file}).config);
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
          "a campaign compares three variants and needs both steps; expected \"both\". For one "
          "step use graspbench optimise --hand H --object O --step N on each scene"}});
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
