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
      "One row per scene: the mean difference of trials on the same pose, with its 95 % interval; "
      "the numbers stand beside the rows.";
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
                         "rows left of zero: there step 1 made the contacts more simultaneous.") +
         DrawDifferences(data, sigma, kStandardGrasp, kNewPreGrasp,
                         "rows right of zero: simultaneous contacts made the grasp firmer.") +
         DrawDifferences(data, sigma, kNewPreGrasp, kNewTarget,
                         "rows right of zero: there the evolved thumb made the grasp firmer, also "
                         "on poses that the evolution had not seen.") +
         DrawDifferences(data, breaking, kNewPreGrasp, kNewTarget,
                         "rows right of zero: what is firmer by sigma also stands a harder pull.");
}

}  // namespace

CampaignSection differences_campaign_section() {
  return {"differences", "Paired differences", DrawDifferences};
}

}  // namespace graspbench
