#include "datasets/session/session_progress.h"

#include <sys/stat.h>

#include <algorithm>
#include <ctime>
#include <string_view>
#include <utility>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "datasets/journal/checked_line.h"
#include "datasets/plan/frozen_folder.h"
#include "datasets/session/judgement_store.h"
#include "datasets/session/session_store.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** Of a line of the plan: what names hand and object. */
std::string_view FindPair(std::string_view line) {
  const size_t start = std::min(line.find(",\"hand\":"), line.size());
  return line.substr(start, line.find(",\"grasp\":", start) - start);
}

/** The plan as far as it matters here. */
struct Outline {
  std::vector<int> group_sizes;
  std::vector<uint64_t> hashes;                  // of the ids, in the plan's order
  std::vector<std::pair<uint64_t, int>> places;  // hash of an id, place; sorted

  /** -1: not in the plan. @param guess  looked at first: journals mostly follow the plan. */
  int FindPlace(std::string_view id, int guess) const {
    const uint64_t hash = CalcHash64(id);
    if (static_cast<size_t>(guess) < hashes.size() && hashes[static_cast<size_t>(guess)] == hash) {
      return guess;
    }
    const auto found = std::lower_bound(places.begin(), places.end(), std::pair(hash, 0));
    return found != places.end() && found->first == hash ? found->second : -1;
  }
};

Outline LoadOutline(const fs::path& path) {
  Outline outline;
  std::string last;
  ForEachLineOfFile(path, [&](const FileLine& line) {
    const std::string_view id = FindTrialId(line.text), pair = FindPair(line.text);
    if (id.empty() || pair.empty()) {
      throw Error(ErrorKind::kFormat, "\"" + path.string() + "\":" + std::to_string(line.number) +
                                          ": it is no planned trial; see graspbench verify");
    }
    if (pair != last) {
      outline.group_sizes.push_back(0);
      last = pair;
    }
    ++outline.group_sizes.back();
    outline.hashes.push_back(CalcHash64(id));
    outline.places.emplace_back(outline.hashes.back(), outline.places.size());
  });
  std::sort(outline.places.begin(), outline.places.end());
  return outline;
}

/** What is to be done and what is, by place in the plan. */
struct Tasks {
  std::vector<bool> planned, finished;
};

void AddShards(const Outline& outline, const Tasks& tasks, int num_shards, const Deal& known,
               double stale_after, std::vector<ShardProgress>& shards) {
  std::vector<ShardProgress> of_deal(static_cast<size_t>(num_shards));
  for (int i = 0; i < num_shards; ++i) of_deal[static_cast<size_t>(i)].shard = {i + 1, num_shards};
  const std::vector<int> deal = DealGroups(outline.group_sizes, num_shards);
  for (size_t place = 0; place < deal.size(); ++place) {
    ShardProgress& progress = of_deal[static_cast<size_t>(deal[place] - 1)];
    progress.num_trials += tasks.planned[place];
    progress.num_finished += tasks.finished[place];
  }
  CompleteShards(known, stale_after, of_deal);
  shards.insert(shards.end(), of_deal.begin(), of_deal.end());
}

/** Of a trial's line: whether the object may be in the hand at the end, so that it can be judged;
as FindUnjudged of judgement_store.h. */
bool IsHeld(std::string_view line) {
  constexpr std::string_view kOutcome = "\"result\":{\"outcome\":\"";
  const size_t begin = line.find(kOutcome);
  if (begin == line.npos || line.find("\"steady_penetration_m\":null", begin) != line.npos) {
    return false;
  }
  const std::string_view rest = line.substr(begin + kOutcome.size());
  const std::string_view name = rest.substr(0, rest.find('"'));
  const std::vector<Outcome>& outcomes = ListOutcomes();
  return std::any_of(outcomes.begin(), outcomes.end(), [&](Outcome outcome) {
    return MayBeInHand(outcome) && name == NameOf(outcome);
  });
}

/** So many bytes of a journal are sealed. */
uintmax_t FindSealed(const Manifest& manifest, const std::string& subfolder,
                     const fs::path& journal) {
  const ManifestFile* file = manifest.Find(subfolder + "/" + journal.filename().string());
  return file ? file->bytes : 0;
}

/** @param held  by place in the plan. */
JudgeProgress ReadJudgeProgress(const fs::path& folder, const Outline& outline,
                                const std::vector<bool>& held, const Manifest& manifest,
                                const Workers& workers, double stale_after) {
  const size_t num_trials = outline.hashes.size();
  Tasks tasks{held, std::vector<bool>(num_trials, false)};
  for (const fs::path& path : ListJournals(folder, "judge")) {
    int place = -1;
    ForEachTrialOf(path, IndexUse::kIgnore, FindSealed(manifest, "judge", path),
                   [&](std::string_view id, std::string_view) {
                     place = outline.FindPlace(id, place + 1);
                     if (place < 0) return;
                     tasks.planned[static_cast<size_t>(place)] = true;
                     tasks.finished[static_cast<size_t>(place)] = true;
                   });
  }
  JudgeProgress progress;
  progress.num_held =
      static_cast<int>(std::count(tasks.planned.begin(), tasks.planned.end(), true));
  progress.num_judged =
      static_cast<int>(std::count(tasks.finished.begin(), tasks.finished.end(), true));
  for (const auto& [num_shards, deal] :
       FindDeals(folder, "judge", kJudgeLabel, workers, static_cast<int>(num_trials))) {
    AddShards(outline, tasks, num_shards, deal, stale_after, progress.shards);
  }
  return progress;
}

}  // namespace

double CalcAge(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return 0.0;
  return std::max(0.0, std::difftime(std::time(nullptr), status.st_mtime));
}

std::map<int, Deal> FindDeals(const fs::path& folder, const char* subfolder,
                              const std::string& prefix, const Workers& workers, int num_trials) {
  std::map<int, Deal> deals;
  const auto look_at = [&](const fs::path& path, const std::string& name) {
    const Shard shard = FindShardOfFile(name);
    if (shard.count == 0 || shard.count > num_trials) return;
    Deal& deal = deals[shard.count];
    double& youngest = deal.ages.try_emplace(shard.number, CalcAge(path)).first->second;
    youngest = std::min(youngest, CalcAge(path));
    if (workers.at_rest.count(prefix + FormatLabel(shard)) > 0) deal.at_rest.insert(shard.number);
  };
  for (const fs::path& path : ListJournals(folder, subfolder)) {
    look_at(path, path.filename().string());
  }
  for (const fs::path& path : ListJournals(folder, "workers")) {
    const std::string name = path.filename().string();
    if (name.compare(0, prefix.size(), prefix) == 0) look_at(path, name.substr(prefix.size()));
  }
  return deals;
}

void CompleteShards(const Deal& deal, double stale_after, std::vector<ShardProgress>& shards) {
  for (ShardProgress& progress : shards) {
    const auto age = deal.ages.find(progress.shard.number);
    if (age != deal.ages.end())
      progress.age = std::min(age->second, progress.age.value_or(age->second));
    if (progress.num_finished == progress.num_trials) {
      progress.state = ShardState::kFinished;
    } else if (deal.at_rest.count(progress.shard.number) > 0) {
      progress.state = ShardState::kStopped;
    } else if (progress.age) {
      progress.state = *progress.age <= stale_after ? ShardState::kRunning : ShardState::kStale;
    }
  }
}

std::set<int> FindShardCounts(const fs::path& folder) {
  std::set<int> counts;
  for (const fs::path& path : ListJournals(folder)) {
    const std::string name = path.filename().string();
    if (name.rfind(kMergedLabel, 0) != 0) counts.insert(FindShardOfFile(name).count);
  }
  return counts;
}

SessionProgress ReadProgress(const fs::path& folder, double stale_after, IndexUse index_use) {
  LoadFrozen(kSessionStore, folder, OnDamage::kRefuse, {kSessionStore.file});
  const Outline outline = LoadOutline(folder / "plan.jsonl");
  const size_t num_trials = outline.hashes.size();
  Tasks tasks{std::vector<bool>(num_trials, true), std::vector<bool>(num_trials, false)};
  std::vector<bool> held(num_trials, false);
  const bool is_believed = index_use == IndexUse::kBelieve;
  const bool has_judge = HasBegunJudge(folder);  // then the lines say what was held
  const Manifest manifest = is_believed ? FindManifest(folder).value_or(Manifest()) : Manifest();
  SessionProgress progress;
  progress.num_trials = static_cast<int>(num_trials);
  for (const fs::path& path : ListJournals(folder)) {
    int place = -1;
    progress.num_bad_lines += ForEachTrialOf(path, has_judge ? IndexUse::kIgnore : index_use,
                                             FindSealed(manifest, "journal", path),
                                             [&](std::string_view id, std::string_view line) {
                                               place = outline.FindPlace(id, place + 1);
                                               if (place < 0) {
                                                 ++progress.num_foreign_lines;
                                               } else {
                                                 tasks.finished[static_cast<size_t>(place)] = true;
                                                 if (has_judge)
                                                   held[static_cast<size_t>(place)] = IsHeld(line);
                                               }
                                             });
  }
  progress.num_finished =
      static_cast<int>(std::count(tasks.finished.begin(), tasks.finished.end(), true));
  progress.damages = FindLostBytes(folder);
  Diagnostics ignored;  // a merge reports them
  const Workers workers = LoadWorkers(folder, ignored);
  progress.unchecked = FindUnchecked(folder, workers.starts);
  for (const auto& [num_shards, deal] :
       FindDeals(folder, "journal", "", workers, progress.num_trials)) {
    AddShards(outline, tasks, num_shards, deal, stale_after, progress.shards);
  }
  if (has_judge) {
    progress.judge = ReadJudgeProgress(folder, outline, held, manifest, workers, stale_after);
  }
  return progress;
}

}  // namespace graspbench
