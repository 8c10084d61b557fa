#include "workbench/campaign_tables.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/text.h"
#include "core/statistics/proportion.h"
#include "core/statistics/summary.h"
#include "workbench/text_table.h"

namespace graspbench {
namespace {

std::string FormatPercentage(double ratio) {
  return std::isfinite(ratio) ? FormatFixed(100.0 * ratio, 1) : "n/a";
}

}  // namespace

std::string FormatVariantsTable(const Campaign& campaign) {
  const std::vector<VariantSummary> summaries = SummariseVariants(campaign.benchmark);
  TextTable table({"variant", "scenes", "trials", "successes", "95 % interval [%]", "median sigma",
                   "median GFT%", "median GOT%", "median GCT [s]"});
  for (const char* variant : {"standard", "new-pregrasp", "new-target"}) {
    std::vector<double> sigma, gft, got, gct;
    int trials = 0, successes = 0;
    for (const VariantSummary& summary : summaries) {
      if (summary.variant != variant) continue;
      trials += summary.trials;
      successes += summary.successes;
      sigma.push_back(summary.mean_sigma);
      gft.push_back(summary.median_gft_ratio);
      got.push_back(summary.median_got_ratio);
      gct.push_back(summary.median_gct);
    }
    table.AddRow(
        {variant, std::to_string(sigma.size()), std::to_string(trials), std::to_string(successes),
         FormatRateInterval(successes, trials), FormatFixed(CalcMedianOfFinite(sigma), 3),
         FormatPercentage(CalcMedianOfFinite(gft)), FormatPercentage(CalcMedianOfFinite(got)),
         FormatFixed(CalcMedianOfFinite(gct), 3)});
  }
  return table.Format();
}

std::string FormatComparisonTable(const Campaign& campaign) {
  if (campaign.comparison.empty()) return "";
  TextTable table(
      {"method", "searches", "median best fitness", "reached 90 %", "median evaluations to 90 %"});
  for (const std::string& method : campaign.config.comparison.methods) {
    std::vector<double> best, evaluations;
    for (const ComparisonRun& run : campaign.comparison) {
      if (run.method != method) continue;
      best.push_back(*std::max_element(run.fitness.begin(), run.fitness.end()));
      if (run.evaluations_to_90 > 0) evaluations.push_back(run.evaluations_to_90);
    }
    const double median = CalcMedianOfFinite(evaluations);
    table.AddRow({method, std::to_string(best.size()), FormatFixed(CalcMedianOfFinite(best), 3),
                  std::to_string(evaluations.size()),
                  std::isfinite(median) ? FormatFixed(median, 0) : "n/a"});
  }
  return table.Format();
}

}  // namespace graspbench
