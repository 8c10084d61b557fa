#include "datasets/analysis/campaign_export.h"

#include <algorithm>
#include <cmath>

#include "core/base/csv.h"
#include "core/base/files.h"
#include "core/statistics/summary.h"

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
  double sum = 0.0;
  std::vector<double> gft, got, gct;
  for (const TrialRecord* record : records) {
    const TrialResult& result = record->result;
    ++summary.trials;
    summary.successes += result.outcome == Outcome::kSuccess;
    if (std::isfinite(result.stability.sigma)) sum += result.stability.sigma;
    gft.push_back(result.timing.gft_ratio);
    got.push_back(result.timing.got_ratio);
    gct.push_back(result.timing.gct);
  }
  summary.mean_sigma = sum / summary.trials;
  summary.median_gft_ratio = CalcMedianOfFinite(gft);
  summary.median_got_ratio = CalcMedianOfFinite(got);
  summary.median_gct = CalcMedianOfFinite(gct);
  return summary;
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

std::vector<VariantSummary> SummariseVariants(const Session& benchmark) {
  std::vector<VariantSummary> summaries;
  std::vector<const TrialRecord*> cell;
  const auto finish_cell = [&] {
    if (!cell.empty()) summaries.push_back(Summarise(cell));
    cell.clear();
  };
  for (const TrialRecord& record : benchmark.records) {
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
  WriteFileAtomically(folder / "summary.csv",
                      FormatCsv(columns, SummariseVariants(campaign.benchmark)));
  if (!campaign.comparison.empty()) {
    WriteFileAtomically(folder / "comparison.csv", FormatComparison(campaign.comparison));
  }
}

}  // namespace graspbench
