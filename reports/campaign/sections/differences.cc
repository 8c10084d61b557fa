#include <cmath>

#include "core/base/text/text.h"
#include "reports/campaign/campaign_section.h"
#include "reports/plots/line_plot.h"

namespace graspbench {
namespace {

Html DrawDifferences(const CampaignData& data, const VariantMeasure& measure, Variant before,
                     Variant after, const std::string& look_for) {
  IntervalPlot plot;
  plot.text.title = std::string(measure.name) + ": " + WordsOf(after) + " minus " + WordsOf(before);
  plot.text.description =
      "One row per scene: mean difference of trials on the same draw, with 95 % interval.";
  plot.axis = "difference of " + std::string(measure.name);
  const double unit = measure.unit;
  for (const std::string& hand : data.benchmark.hands) {
    plot.AddHeading(data.models.NameOfHand(hand));
    for (const SceneVariants& scene : data.scenes) {
      if (scene.hand != hand) continue;
      IntervalPlot::Row row;
      row.label = data.models.NameOfObject(scene.object);
      row.anchor = scene.key;
      row.series = hand == data.benchmark.hands.front() ? 0 : 1;
      const PairedDifference pairs = CalcPairedDifference(measure, scene, before, after);
      row.value = unit * pairs.mean;
      if (pairs.interval) {
        row.low = unit * pairs.interval->interval.low;
        row.high = unit * pairs.interval->interval.high;
        row.text = FormatWithRange(row.value, row.low, row.high, measure.decimals) + ", " +
                   FormatCount(pairs.num_pairs, "pair");
      } else {
        row.low = row.high = std::nan("");
        row.text =
            FormatFixed(row.value, measure.decimals) + ", no interval: " + pairs.interval.reason();
      }
      plot.rows.push_back(row);
    }
  }
  return MakeFigure(plot.text.title + ", paired by trial pose.", look_for,
                    MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

Html DrawDifferences(const CampaignData& data) {
  if (data.benchmark.hands.empty()) return MakeParagraph("There is nothing to compare.");
  const VariantMeasure& gft = FindVariantMeasure("GFT%");
  const VariantMeasure& sigma = FindVariantMeasure("sigma");
  const VariantMeasure& breaking = FindVariantMeasure("breaking");
  return DrawDifferences(data, gft, kStandardGrasp, kNewPreGrasp,
                         "rows left of zero: step 1 made the contacts more simultaneous.") +
         DrawDifferences(data, sigma, kStandardGrasp, kNewPreGrasp,
                         "rows right of zero: simultaneous contacts made the grasp more stable.") +
         DrawDifferences(data, sigma, kNewPreGrasp, kNewTarget,
                         "rows right of zero: the optimised thumb posture made the grasp more "
                         "stable on unseen draws.") +
         DrawDifferences(
             data, breaking, kNewPreGrasp, kNewTarget,
             "rows right of zero: a grasp with higher sigma also has a higher breaking force.");
}

}  // namespace

CampaignSection differences_campaign_section() {
  return {"differences", "Paired differences", DrawDifferences};
}

}  // namespace graspbench
