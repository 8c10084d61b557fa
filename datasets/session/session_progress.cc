#include "datasets/session/session_progress.h"

#include <sys/stat.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "datasets/journal/checked_line.h"
#include "datasets/session/frozen_folder.h"
#include "datasets/session/session_store.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** Ids stand first in every line of plan and journals. Empty: the line begins otherwise. */
std::string_view FindId(std::string_view line) {
  constexpr std::string_view kHead = "{\"trial_id\":\"";
  constexpr size_t kIdLength = 16;
  if (line.substr(0, kHead.size()) != kHead) return {};
  line.remove_prefix(kHead.size());
  return line.substr(0, line.find('"')).size() == kIdLength ? line.substr(0, kIdLength)
                                                            : std::string_view();
}

/** Of a line of the plan: what names hand and object. */
std::string_view FindPair(std::string_view line) {
  const size_t start = std::min(line.find(",\"hand\":"), line.size());
  return line.substr(start, line.find(",\"grasp\":", start) - start);
}

/** The plan as far as it matters here. */
struct Outline {
  std::vector<int> group_sizes;
  std::vector<std::pair<uint64_t, int>> places;  // hash of an id, place; sorted

  /** -1: not in the plan. */
  int FindPlace(std::string_view id) const {
    const uint64_t hash = CalcHash64(id);
    const auto found = std::lower_bound(places.begin(), places.end(), std::pair(hash, 0));
    return found != places.end() && found->first == hash ? found->second : -1;
  }
};

Outline LoadOutline(const fs::path& path) {
  Outline outline;
  std::string last;
  int place = 0;
  ForEachLineOfFile(path, [&](const FileLine& line) {
    const std::string_view id = FindId(line.text), pair = FindPair(line.text);
    if (id.empty() || pair.empty()) {
      throw Error(ErrorKind::kFormat, "\"" + path.string() + "\":" + std::to_string(line.number) +
                                          ": it is no planned trial; see graspbench verify");
    }
    if (pair != last) {
      outline.group_sizes.push_back(0);
      last = pair;
    }
    ++outline.group_sizes.back();
    outline.places.emplace_back(CalcHash64(id), place++);
  });
  std::sort(outline.places.begin(), outline.places.end());
  return outline;
}

double CalcAge(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return 0.0;
  return std::max(0.0, std::difftime(std::time(nullptr), status.st_mtime));
}

ShardState FindState(const ShardProgress& progress, double stale_after) {
  if (progress.num_finished == progress.num_trials) return ShardState::kFinished;
  if (!progress.age) return ShardState::kWaiting;
  return *progress.age <= stale_after ? ShardState::kRunning : ShardState::kStale;
}

/** The shards of one deal. @param ages  of those that have journals, by number. */
void AddShards(const Outline& outline, const std::vector<bool>& finished, int num_shards,
               const std::map<int, double>& ages, double stale_after,
               std::vector<ShardProgress>& shards) {
  std::vector<ShardProgress> of_deal(static_cast<size_t>(num_shards));
  for (int i = 0; i < num_shards; ++i) of_deal[static_cast<size_t>(i)].shard = {i + 1, num_shards};
  const std::vector<int> deal = DealGroups(outline.group_sizes, num_shards);
  for (size_t place = 0; place < deal.size(); ++place) {
    ShardProgress& progress = of_deal[static_cast<size_t>(deal[place] - 1)];
    ++progress.num_trials;
    progress.num_finished += finished[place];
  }
  for (ShardProgress& progress : of_deal) {
    const auto age = ages.find(progress.shard.number);
    if (age != ages.end()) progress.age = age->second;
    progress.state = FindState(progress, stale_after);
    shards.push_back(progress);
  }
}

}  // namespace

SessionProgress ReadProgress(const fs::path& folder, double stale_after) {
  LoadFrozen(kSessionStore, folder, OnDamage::kRefuse, {kSessionStore.file});
  const Outline outline = LoadOutline(folder / "plan.jsonl");
  std::vector<bool> finished(outline.places.size(), false);
  std::map<int, std::map<int, double>> ages;  // by number of shards, by shard
  SessionProgress progress;
  progress.num_trials = static_cast<int>(finished.size());
  for (const fs::path& path : ListJournals(folder)) {
    const Shard shard = FindShardOfFile(path.filename().string());
    if (0 < shard.count && shard.count <= progress.num_trials) {
      const double age = CalcAge(path);
      double& youngest = ages[shard.count].try_emplace(shard.number, age).first->second;
      youngest = std::min(youngest, age);
    }
    ForEachLineOfFile(path, [&](const FileLine& line) {
      if (line.text.empty() || !line.is_whole) return;
      const int place = outline.FindPlace(FindId(line.text));
      if (place < 0 || !IsCheckedLine(line.text)) {
        ++progress.num_bad_lines;
      } else {
        finished[static_cast<size_t>(place)] = true;
      }
    });
  }
  progress.num_finished = static_cast<int>(std::count(finished.begin(), finished.end(), true));
  for (const auto& [num_shards, of_deal] : ages) {
    AddShards(outline, finished, num_shards, of_deal, stale_after, progress.shards);
  }
  return progress;
}

}  // namespace graspbench
