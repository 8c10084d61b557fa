#include "workbench/tables/campaign_tables.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/statistics/proportion.h"
#include "datasets/analysis/campaign/campaign_summary.h"
#include "workbench/tables/optimise_tables.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

std::string FormatPercentage(double ratio) {
  return std::isfinite(ratio) ? FormatFixed(100.0 * ratio, 1) : "n/a";
}

}  // namespace

std::string FormatVariantsTable(const Campaign& campaign) {
  TextTable table({"variant", "scenes", "trials", "successes", "95 % interval [%]", "median sigma",
                   "median GFT%", "median GOT%", "median GCT [s]"});
  for (const VariantTotal& total : ListVariantTotals(campaign)) {
    table.AddRow({NameOf(total.variant), std::to_string(total.num_scenes),
                  std::to_string(total.trials), std::to_string(total.successes),
                  FormatRateInterval(total.successes, total.trials),
                  FormatFixed(total.median_sigma, 3), FormatPercentage(total.median_gft_ratio),
                  FormatPercentage(total.median_got_ratio), FormatFixed(total.median_gct, 3)});
  }
  return table.Format();
}

std::string FormatComparisonTable(const Campaign& campaign) {
  const std::vector<MethodTotal> totals = ListMethodTotals(campaign);
  if (totals.empty()) return "";
  TextTable table(
      {"method", "searches", "median best fitness", "reached 90 %", "median evaluations to 90 %"});
  for (const MethodTotal& total : totals) {
    const double median = total.median_evaluations_to_90;
    table.AddRow({total.method, std::to_string(total.num_searches),
                  FormatFixed(total.median_best_fitness, 3), std::to_string(total.num_reached_90),
                  std::isfinite(median) ? FormatFixed(median, 0) : "n/a"});
  }
  return table.Format();
}

std::string DescribeNumericalFailures(const Campaign& campaign) {
  std::string text;
  const auto add = [&text](const std::string& where, const std::string& what) {
    if (!what.empty()) text += (text.empty() ? "" : "\n") + where + ": " + what;
  };
  for (const SceneRecord& scene : campaign.scenes) {
    add(scene.config.hand + ", " + scene.config.object,
        DescribeNumericalFailures(scene.evaluations));
  }
  const auto& records = campaign.benchmark.records;
  const auto count = std::count_if(records.begin(), records.end(), [](const TrialRecord& record) {
    return record.result.outcome == Outcome::kNumericalFailure;
  });
  if (count > 0) {
    add("benchmark", FormatCount(count, "trial") +
                         " failed numerically; benchmark/export/trials.csv names them");
  }
  return text;
}

}  // namespace graspbench
