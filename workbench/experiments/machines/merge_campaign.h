#pragma once
/** @file
A campaign whose shards were worked on, in one folder or several: what is finished is put together,
and what comes next is planned. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

/** What is not finished; the next follows when all of one is. */
struct CampaignRest {
  int scenes = 0, trials = 0, judgements = 0, searches = 0;
  int sum() const { return scenes + trials + judgements + searches; }
};

/** Merges scenes, searches and the benchmark, which is planned when all scenes are finished; writes
the benchmark's exports when it is finished and judged. @throws as MergeCampaigns, MergeSessions. */
CampaignRest MergeCampaign(const std::filesystem::path& folder,
                           const std::vector<std::filesystem::path>& others);

/** Machines that disagree or were not asked, in any part of the campaign, as sentences. */
std::vector<std::string> DescribeCampaignMachines(const std::filesystem::path& folder);

}  // namespace graspbench
