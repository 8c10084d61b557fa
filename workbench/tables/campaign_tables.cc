#include "workbench/tables/campaign_tables.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/statistics/proportion.h"
#include "datasets/analysis/campaign/campaign_summary.h"
#include "datasets/analysis/campaign/headrooms.h"
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
                   "median GFT%", "its floor", "median GOT%", "median GCT [s]"});
  for (const VariantTotal& total : ListVariantTotals(campaign)) {
    table.AddRow({NameOf(total.variant), std::to_string(total.num_scenes),
                  std::to_string(total.trials), std::to_string(total.successes),
                  FormatRateInterval(total.successes, total.trials),
                  FormatFixed(total.median_sigma, 3), FormatPercentage(total.median_gft_ratio),
                  std::isfinite(total.median_gft_floor) ? FormatPercentage(total.median_gft_floor)
                                                        : "no floor",
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

std::string FormatCampaign(const Campaign& campaign, const std::filesystem::path& folder,
                           const std::filesystem::path& report) {
  const std::string comparison = FormatComparisonTable(campaign);
  std::string headroom;
  for (const Headrooms& hand : ListHeadrooms(campaign)) {
    headroom += "\nheadroom " + hand.hand + ": " + DescribeHeadrooms(hand);
  }
  return "\n" + FormatVariantsTable(campaign) + (comparison.empty() ? "" : "\n" + comparison) +
         headroom + "\nreport   " + report.string() + "\ndata     " +
         (folder / "summary.csv").string() + "\n";
}

Json MakeCampaignJson(const Campaign& campaign, const std::filesystem::path& folder,
                      const std::filesystem::path& report) {
  Json variants = Json::array(), methods = Json::array(), headrooms = Json::array();
  for (const VariantTotal& total : ListVariantTotals(campaign)) {
    variants.push_back({{"variant", NameOf(total.variant)},
                        {"scenes", total.num_scenes},
                        {"trials", total.trials},
                        {"successes", total.successes},
                        {"median_sigma_n", JsonNumber(total.median_sigma)},
                        {"median_gft_ratio", JsonNumber(total.median_gft_ratio)},
                        {"median_gft_ratio_floor", JsonNumber(total.median_gft_floor)},
                        {"median_got_ratio", JsonNumber(total.median_got_ratio)},
                        {"median_gct_s", JsonNumber(total.median_gct)}});
  }
  for (const MethodTotal& total : ListMethodTotals(campaign)) {
    methods.push_back({{"method", total.method},
                       {"searches", total.num_searches},
                       {"median_best_fitness", JsonNumber(total.median_best_fitness)},
                       {"reached_90", total.num_reached_90},
                       {"median_evaluations_to_90", JsonNumber(total.median_evaluations_to_90)}});
  }
  for (const Headrooms& hand : ListHeadrooms(campaign)) {
    headrooms.push_back({{"hand", hand.hand},
                         {"scenes", hand.num_scenes},
                         {"median_share_start", JsonNumber(hand.median_start)},
                         {"median_share_kept", JsonNumber(hand.median_kept)},
                         {"scenes_without", hand.num_without},
                         {"why_without", hand.why_without}});
  }
  return {{"campaign", folder.string()},
          {"report", report.string()},
          {"scenes", campaign.scenes.size()},
          {"variants", variants},
          {"methods", methods},
          {"headroom", headrooms}};
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
