#include "datasets/analysis/development_summary.h"

#include <algorithm>

namespace graspbench {

std::vector<std::vector<DevelopmentStage>> SummariseDevelopment(const DevelopmentJournal& journal) {
  std::vector<std::vector<DevelopmentStage>> grasps;
  const std::vector<Outcome>& outcomes = ListOutcomes();
  std::string last = "check";
  for (int request = 0; const DevelopmentRecord* record = journal.Find(request); ++request) {
    if (last == "check" && record->stage != "check") grasps.emplace_back();
    if (grasps.empty()) grasps.emplace_back();
    std::vector<DevelopmentStage>& stages = grasps.back();
    if (stages.empty() || stages.back().name != record->stage) {
      stages.emplace_back().name = record->stage;
    }
    last = record->stage;
    DevelopmentStage& stage = stages.back();
    ++stage.num_requests;
    stage.best_score = std::max(stage.best_score, CalcMeanScore(record->trials));
    for (const DevelopTrial& trial : record->trials) {
      const auto place = std::find(outcomes.begin(), outcomes.end(), trial.outcome);
      ++stage.tally.planned;
      if (place == outcomes.end()) continue;
      ++stage.tally.finished;
      ++stage.tally.outcomes[static_cast<size_t>(place - outcomes.begin())];
    }
  }
  return grasps;
}

}  // namespace graspbench
