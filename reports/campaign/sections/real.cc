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
      "Success over the scenes in which all three variants were really tried, 95 % intervals in "
      "per cent.",
      {"Variant", "Scenes", "Really", "In the simulation"});
  for (const RealTotal& total : found.totals) {
    table.AddRow({WordsOf(total.variant), total.num_scenes, FormatCounts(total.real),
                  FormatCounts(total.simulated)});
  }
  return table.ToHtml();
}

Html DrawAgreements(const RealComparison& found) {
  Table table(
      "Does a step change reality as it changes the simulation? Scenes in which both change.",
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
  Table table("Every scene of which there are real trials.",
              {"Scene",
               "Variant",
               "Success, really [95 %]",
               "In the simulation",
               {"p",
                "that both succeed as often: Fisher's exact test, two-sided, "
                "not corrected for the number of rows"},
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
                                   "There are none of these scenes. A laboratory that tries the "
                                   "grasps with its own hands fills in the table "
                                   "that graspbench new trials DIR writes; graspbench campaign "
                                   "--out DIR --resume --real FILE "
                                   "puts it here, beside the simulated trials.");
  }
  const RealComparison found = CompareWithReal(data.campaign.real, data.scenes);
  Html html = DrawFigures(data);
  if (data.campaign.real.front().is_published) {
    html += MakeParagraph(FormatCount(num_all, "trial") +
                          " of these are published ones, whose source stands in the program's "
                          "datasets/real; a laboratory's own take their place (--real FILE).");
  }
  if (found.num_made_up > 0) {
    html += MakeParagraph("Not a measurement: " + std::to_string(found.num_made_up) + " of these " +
                          FormatCount(num_all, "trial") + " are marked as made up in their notes.");
  }
  if (found.num_unmatched > 0) {
    html += MakeParagraph(FormatCount(found.num_unmatched, "trial") +
                          " of scenes that are not finished are left out.");
  }
  if (found.cells.empty()) return html;
  return html + (found.totals.empty() ? Html() : DrawTotals(found)) + DrawAgreements(found) +
         DrawCells(found, data) +
         MakeParagraph(
             "A laboratory's own trials are kept in real/trials.csv. That two success rates do not "
             "differ significantly in few trials does not mean that they are equal.");
}

}  // namespace

CampaignSection real_campaign_section() { return {"real", "Trials with real hands", DrawReal}; }

}  // namespace graspbench
