#pragma once
/** @file
How far a campaign, an optimisation or a development is, from its folders and journals alone; no
hand or object is loaded. */

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "datasets/session/session_progress.h"

namespace graspbench {

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
