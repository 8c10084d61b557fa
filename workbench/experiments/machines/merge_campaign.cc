#include "workbench/experiments/machines/merge_campaign.h"

#include "datasets/campaign/merge_campaigns.h"
#include "datasets/session/judgement_store.h"
#include "datasets/session/merge_sessions.h"
#include "datasets/shards/worker_log.h"
#include "workbench/experiments/run_campaign.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

int CountSearchesLeft(const fs::path& folder) {
  const CampaignConfig config = LoadCampaignConfig(folder);
  const SessionInputs inputs = LoadSessionInputs(config.session, FieldUse::kNow, folder);
  const std::vector<CampaignScene> scenes = PlanScenes(config, inputs, folder);
  return static_cast<int>(ListComparisons(PlanComparison(config, scenes, folder)).left.size());
}

}  // namespace

CampaignRest MergeCampaign(const fs::path& folder, const std::vector<fs::path>& others) {
  const fs::path benchmark = folder / "benchmark";
  MergeCampaigns(folder, others);
  CampaignRest rest;
  rest.scenes = PlanBenchmark(folder);
  if (!HasSession(benchmark)) {
    SealStore(kCampaignStore, folder);
    return rest;
  }
  std::vector<fs::path> sessions;
  for (const fs::path& other : others) {
    if (HasSession(other / "benchmark")) sessions.push_back(other / "benchmark");
  }
  MergeSessions(benchmark, sessions);
  const Session session = LoadSession(benchmark);
  SealStore(kSessionStore, benchmark);
  rest.trials = static_cast<int>(FindUnfinished(session).size());
  rest.judgements = static_cast<int>(FindUnjudged(session).size());
  rest.searches = CountSearchesLeft(folder);
  if (rest.trials + rest.judgements == 0) ExportSession(benchmark, session);
  SealStore(kCampaignStore, folder);
  return rest;
}

std::vector<std::string> DescribeCampaignMachines(const fs::path& folder) {
  Diagnostics ignored;
  std::vector<WorkerStart> starts = LoadWorkers(folder, ignored).starts;
  std::set<std::string> unchecked = FindUnchecked(folder, starts);
  if (HasSession(folder / "benchmark")) {
    const std::vector<WorkerStart> more = LoadWorkers(folder / "benchmark", ignored).starts;
    const std::set<std::string> others = FindUnchecked(folder / "benchmark", more);
    unchecked.insert(others.begin(), others.end());
    starts.insert(starts.end(), more.begin(), more.end());
  }
  std::vector<std::string> sentences = DescribeDifferences(starts);
  if (!unchecked.empty()) sentences.push_back(DescribeUnchecked(unchecked));
  return sentences;
}

}  // namespace graspbench
