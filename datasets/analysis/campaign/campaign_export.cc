#include "datasets/analysis/campaign/campaign_export.h"

#include <algorithm>
#include <map>

#include "core/base/text/csv.h"
#include "datasets/analysis/campaign/campaign_summary.h"
#include "datasets/analysis/campaign/gft_floors.h"
#include "datasets/analysis/campaign/headrooms.h"
#include "datasets/journal/sealed_store.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

VariantSummary Summarise(const std::vector<const TrialRecord*>& records) {
  VariantSummary summary;
  const PlannedTrial& plan = records.front()->plan;
  summary.hand = plan.hand;
  summary.object = plan.object;
  summary.grasp = plan.grasp;
  summary.variant = VariantOfGrasp(plan.grasp);
  CellSummary cell;
  cell.records = records;
  for (const TrialRecord* record : records) {
    ++summary.trials;
    summary.successes += record->result.outcome == Outcome::kSuccess;
  }
  const auto calc = [&](const char* measure) {
    return CalcCellValue(FindVariantMeasure(measure), cell);
  };
  summary.mean_sigma = calc("sigma");
  summary.median_gft_ratio = calc("GFT%");
  if (const Answer<double> floor = CalcGftFloorOf(records)) summary.gft_ratio_floor = *floor;
  summary.median_got_ratio = calc("GOT%");
  summary.median_gct = calc("GCT");
  summary.mean_breaking_force = calc("breaking");
  summary.median_grip = calc("grip");
  summary.median_sigma_ratio = calc("sigma/grip");
  summary.median_breaking_ratio = calc("breaking/grip");
  return summary;
}

/** NaN: none. */
double FindHeadroomShare(const Campaign& campaign, const VariantSummary& summary) {
  if (summary.variant == kStandardGrasp) return kUnset;
  for (const SceneRecord& scene : campaign.scenes) {
    if (scene.config.hand != summary.hand || scene.config.object != summary.object) continue;
    const Answer<SceneHeadroom> headroom = FindHeadroom(scene);
    if (!headroom) return kUnset;
    return summary.variant == kNewTarget ? headroom->kept_share : headroom->start_share;
  }
  return kUnset;
}

std::string FormatComparison(const std::vector<ComparisonRun>& runs) {
  std::string csv = FormatCsvLine({"hand", "object", "method", "seed", "evaluations",
                                   "start_fitness", "best_fitness", "evaluations_to_90"});
  for (const ComparisonRun& run : runs) {
    const Json to_90 = run.evaluations_to_90 > 0 ? Json(run.evaluations_to_90) : Json();
    csv += FormatCsvLine({run.hand, run.object, run.method, run.seed, run.fitness.size(),
                          run.fitness.front(),
                          *std::max_element(run.fitness.begin(), run.fitness.end()), to_90});
  }
  return csv;
}

}  // namespace

std::vector<VariantSummary> SummariseVariants(const Campaign& campaign) {
  std::vector<VariantSummary> summaries;
  std::vector<const TrialRecord*> cell;
  const auto finish_cell = [&] {
    if (cell.empty()) return;
    summaries.push_back(Summarise(cell));
    summaries.back().headroom_share = FindHeadroomShare(campaign, summaries.back());
    cell.clear();
  };
  for (const TrialRecord& record : campaign.benchmark.records) {
    if (!cell.empty()) {
      const PlannedTrial& last = cell.back()->plan;
      if (last.hand != record.plan.hand || last.object != record.plan.object ||
          last.grasp != record.plan.grasp) {
        finish_cell();
      }
    }
    cell.push_back(&record);
  }
  finish_cell();
  return summaries;
}

void ExportCampaign(const fs::path& folder, const Campaign& campaign) {
  std::vector<CsvColumn<VariantSummary>> columns;
  AddFieldColumns<VariantSummary>(
      [](const VariantSummary& summary) -> const VariantSummary& { return summary; }, columns);
  std::map<std::string, std::string> tables = {
      {"summary.csv", FormatCsv(columns, SummariseVariants(campaign))}};
  if (!campaign.comparison.empty()) {
    tables["comparison.csv"] = FormatComparison(campaign.comparison);
  }
  WriteDerived(kCampaignStore, folder, tables);
}

}  // namespace graspbench
