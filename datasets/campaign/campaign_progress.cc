#include "datasets/campaign/campaign_progress.h"

#include <algorithm>
#include <map>

#include "datasets/campaign/campaign_store.h"
#include "datasets/journal/checked_line.h"
#include "datasets/shards/worker_log.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** @param ages  of the workers' files of one deal, by shard [s]. */
void AddShards(const std::vector<fs::path>& scenes, int num_shards,
               const std::map<int, double>& ages, const std::set<std::string>& at_rest,
               double stale_after, std::vector<ShardProgress>& shards) {
  for (int number = 1; number <= num_shards; ++number) {
    ShardProgress progress;
    progress.shard = {number, num_shards};
    const auto age = ages.find(number);
    if (age != ages.end()) progress.age = age->second;
    for (size_t i = 0; i < scenes.size(); ++i) {
      if (!IsCardOf(i, progress.shard)) continue;
      ++progress.num_trials;
      progress.num_finished += HasSceneResult(scenes[i]);
      const fs::path journal = scenes[i] / "journal.jsonl";
      if (progress.age && fs::exists(journal)) {
        progress.age = std::min(*progress.age, CalcAge(journal));
      }
    }
    const bool is_at_rest = at_rest.count(FormatLabel(progress.shard)) > 0;
    progress.state = FindState(progress, is_at_rest, stale_after);
    shards.push_back(progress);
  }
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
  std::map<int, std::map<int, double>> ages;  // by number of shards, by shard
  for (const fs::path& path : ListJournals(folder, "workers")) {
    const Shard shard = FindShardOfFile(path.filename().string());
    constexpr int kMostShards = 100000;  // a file of another origin must not fill the memory
    if (shard.count == 0 || shard.count > kMostShards) continue;
    KeepYoungest(shard.number, CalcAge(path), ages[shard.count]);
  }
  for (const auto& [num_shards, of_deal] : ages) {
    AddShards(scenes, num_shards, of_deal, workers.at_rest, stale_after, progress.shards);
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
      std::any_of(files.begin(), files.end(),
                  [](const ManifestFile& file) { return file.path == "result.json"; });
  if (!fs::exists(journal)) return progress;
  progress.age = CalcAge(journal);
  ForEachLineOfFile(journal, [&](const FileLine& line) {
    if (!line.is_whole || line.text.empty()) return;
    ++(IsCheckedLine(line.text) ? progress.num_answers : progress.num_bad_lines);
  });
  return progress;
}

}  // namespace graspbench
