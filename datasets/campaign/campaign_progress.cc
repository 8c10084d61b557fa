#include "datasets/campaign/campaign_progress.h"

#include <algorithm>

#include "datasets/campaign/campaign_store.h"
#include "datasets/journal/checked_line.h"
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
  const std::vector<ManifestFile> files = FindManifest(folder).value_or(Manifest()).files;
  progress.is_finished =  // a result counts when it is sealed
      std::any_of(files.begin(), files.end(), [](const ManifestFile& file) {
        return file.path == "result.json" || file.path == "grasps.csv";
      });
  if (!fs::exists(journal)) return progress;
  progress.age = CalcAge(journal);
  ForEachLineOfFile(journal, [&](const FileLine& line) {
    if (!line.is_whole || line.text.empty()) return;
    ++(IsCheckedLine(line.text) ? progress.num_answers : progress.num_bad_lines);
  });
  return progress;
}

}  // namespace graspbench
