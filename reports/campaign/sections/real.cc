#include <algorithm>

#include "core/base/text/text.h"
#include "datasets/analysis/campaign/real_comparison.h"
#include "reports/campaign/campaign_section.h"

namespace graspbench {
namespace {

std::string FormatCounts(const Tally& tally) {
  return std::to_string(tally.successes()) + " of " + std::to_string(tally.finished) + " (" +
         FormatRateInterval(tally) + ")";
}

Html DrawTotals(const RealComparison& found) {
  Table table(
      "Success rate [%] over the scenes with real trials of all three variants, with 95 % "
      "intervals.",
      {"Variant", "Scenes", "Really", "In the simulation"});
  for (const RealTotal& total : found.totals) {
    table.AddRow({WordsOf(total.variant), total.num_scenes, FormatCounts(total.real),
                  FormatCounts(total.simulated)});
  }
  return table.ToHtml();
}

Html DrawAgreements(const RealComparison& found) {
  Table table("Do real hands change as the simulation does? Scenes in which both change.",
              {"Step", "Measure", "Scenes", "Alike", "95 % interval [%]"});
  for (const RealAgreement& agreement : found.agreements) {
    table.AddRow({agreement.step, agreement.measure, agreement.num_scenes, agreement.num_alike,
                  agreement.num_scenes == 0
                      ? "n/a"
                      : FormatRange(100.0 * agreement.share.low, 100.0 * agreement.share.high, 1)});
  }
  return table.ToHtml();
}

Html DrawCells(const RealComparison& found, const CampaignData& data) {
  const VariantMeasure& gft = FindVariantMeasure("GFT%");
  Table table("All scenes with real trials.", {"Scene",
                                               "Variant",
                                               "Success, really [95 %]",
                                               "In the simulation",
                                               {"p",
                                                "equal success rates: Fisher's exact test, "
                                                "two-sided, not corrected for the number of rows"},
                                               {"Median GFT%, really [%]",
                                                "of the trials in which all digits of "
                                                "the grasp touched"},
                                               "Trials with it",
                                               "In the simulation [%]"});
  for (const RealCell& cell : found.cells) {
    const CellSummary& simulated = cell.scene->cell(cell.variant);
    table.AddRow({LinkTo(cell.scene->key, data.NameOfScene(*cell.scene)), WordsOf(cell.variant),
                  FormatCounts(cell.real), FormatCounts(simulated.tally),
                  cell.success_p < 0.001 ? "< 0.001" : FormatFixed(cell.success_p, 3),
                  FormatFixed(gft.unit * cell.median_gft_ratio(), 1), cell.gft_ratios.size(),
                  FormatFixed(gft.unit * CalcCellValue(gft, simulated), 1)});
  }
  return table.ToHtml();
}

Html DrawFigures(const CampaignData& data) {
  Table table("Published figures of real hands and of people.", {"Of", "What", "Value", "Source"});
  for (const PublishedFigure& figure : LoadPublishedFigures()) {
    const bool is_here =
        figure.hand == "people" ||
        std::any_of(data.scenes.begin(), data.scenes.end(),
                    [&](const SceneVariants& scene) { return scene.hand == figure.hand; });
    if (!is_here) continue;
    table.AddRow(
        {figure.hand, figure.what, FormatJson(figure.value) + " " + figure.unit, figure.source});
  }
  return table.ToHtml();
}

Html DrawReal(const CampaignData& data) {
  const auto num_all = static_cast<int>(data.campaign.real.size());
  if (num_all == 0) {
    return DrawFigures(data) + MakeParagraph(
                                   "These scenes have no real trials. graspbench new trials DIR "
                                   "writes a table for a laboratory's own trials; graspbench "
                                   "campaign --out DIR --resume --real FILE adds them here.");
  }
  const RealComparison found = CompareWithReal(data.campaign.real, data.scenes);
  Html html = DrawFigures(data);
  if (data.campaign.real.front().is_published) {
    html += MakeParagraph(FormatCount(num_all, "trial") +
                          " of these are published trials (source: datasets/real); a laboratory's "
                          "own trials replace them (--real FILE).");
  }
  if (found.num_made_up > 0) {
    html +=
        MakeParagraph("Not a measurement: " + std::to_string(found.num_made_up) + " of these " +
                      FormatCount(num_all, "trial") + " are marked as synthetic in their notes.");
  }
  if (found.num_unmatched > 0) {
    html += MakeParagraph(FormatCount(found.num_unmatched, "trial") +
                          " of unfinished scenes are left out.");
  }
  if (found.cells.empty()) return html;
  return html + (found.totals.empty() ? Html() : DrawTotals(found)) + DrawAgreements(found) +
         DrawCells(found, data) +
         MakeParagraph(
             "A laboratory's own trials are kept in real/trials.csv. A non-significant difference "
             "in few trials does not show equality.");
}

}  // namespace

CampaignSection real_campaign_section() { return {"real", "Trials with real hands", DrawReal}; }

}  // namespace graspbench
