#include <cmath>

#include "core/base/text/text.h"
#include "datasets/analysis/campaign/headrooms.h"
#include "reports/campaign/campaign_section.h"
#include "reports/plots/line_plot.h"

namespace graspbench {
namespace {

struct Claim {
  const char* measure;
  const char* words;
  const char* unit;
  Variant before, after;
  const char* step;
};
constexpr Claim kClaims[] = {
    {"GFT%", "GFT%", "\u00A0%", kStandardGrasp, kNewPreGrasp, "step 1, the new pre-grasp,"},
    {"sigma", "the stability sigma", "\u00A0N", kNewPreGrasp, kNewTarget,
     "step 2, the new target posture,"},
    {"breaking", "the breaking force", "\u00A0N", kStandardGrasp, kNewTarget,
     "both steps together"}};

StepEffect FindEffect(const CampaignData& data, const Claim& claim) {
  return CalcStepEffect(FindVariantMeasure(claim.measure), data.scenes, claim.before, claim.after);
}

/** "Step 1 .. changed the median of GFT% by the factor 0.80 (0.70 to 0.92)". */
std::string DescribeClaim(const Claim& claim, const StepEffect& effect) {
  if (effect.num_scenes == 0) return {};
  const VariantMeasure& measure = FindVariantMeasure(claim.measure);
  const auto format = [&](double value) {
    return FormatFixed(measure.unit * value, measure.decimals) + claim.unit;
  };
  const std::string before = format(effect.median_before), after = format(effect.median_after);
  if (before == after) {
    return Capitalise(claim.step) + " left the median of " + claim.words + " at " + after + ". ";
  }
  std::string text = Capitalise(claim.step) + " changed the median of " + claim.words + " from " +
                     before + " to " + after;
  if (effect.ratio) {
    const auto& interval = effect.ratio->interval;
    text += ", by a factor of " +
            FormatWithRange(effect.ratio->estimate, interval.low, interval.high, 2) +
            (interval.low <= 1.0 && 1.0 <= interval.high ? ", not significant" : "");
  }
  return text + ". ";
}

/** Plots changes of medians in per cent, so that all measures share one axis. */
Html DrawChanges(const CampaignData& data) {
  struct Step {
    const char* name;
    Variant before, after;
  };
  constexpr Step kSteps[] = {{"step 1", kStandardGrasp, kNewPreGrasp},
                             {"step 2", kNewPreGrasp, kNewTarget},
                             {"both", kStandardGrasp, kNewTarget}};
  IntervalPlot plot;
  plot.text.title = "Effects of the two steps";
  plot.text.description = "Change of the median of each measure, one row per measure and step.";
  plot.axis = "change of the median over the scenes [%]";
  int series = 0;
  for (const Step& step : kSteps) {
    plot.AddHeading(step.name);
    for (const VariantMeasure& measure : ListVariantMeasures()) {
      const StepEffect effect = CalcStepEffect(measure, data.scenes, step.before, step.after);
      if (effect.num_scenes == 0 || !std::isfinite(effect.plain_ratio())) continue;
      IntervalPlot::Row row;
      const std::string name = measure.name;
      row.label = name.substr(0, name.find(" ["));
      row.series = series;
      const std::string scenes = ", " + FormatCount(effect.num_scenes, "scene");
      if (effect.ratio) {
        row.value = 100.0 * (effect.ratio->estimate - 1.0);
        row.low = 100.0 * (effect.ratio->interval.low - 1.0);
        row.high = 100.0 * (effect.ratio->interval.high - 1.0);
        row.text = FormatWithRange(row.value, row.low, row.high, 0) + scenes;
      } else {
        row.value = 100.0 * (effect.plain_ratio() - 1.0);
        row.low = row.high = std::nan("");
        row.text = FormatFixed(row.value, 0) + scenes + ", no interval";
      }
      plot.rows.push_back(row);
    }
    ++series;
  }
  return MakeFigure(
      "Change of the median of each measure with 95 % bootstrap intervals over scenes.",
      "intervals that exclude 0. Success, sigma and breaking force should increase; GFT%, GOT% and "
      "GCT should decrease.",
      MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

Html DrawSummary(const CampaignData& data) {
  const int num_complete = CountComplete(data.scenes);
  const size_t num_findings = ListCampaignFindings(data).size();
  Html html;
  if (num_complete == 0) {
    html += MakeParagraph("No scene has trials of all three variants yet.");
  } else {
    std::string text = FormatCount(num_complete, "scene") + " (a hand and an object) have trials " +
                       "of all three variants. ";
    if (num_complete == 1)
      text = "One scene (a hand and an object) has trials of all three variants. ";
    for (const Claim& claim : kClaims) text += DescribeClaim(claim, FindEffect(data, claim));
    text +=
        Capitalise(DescribeGftFloors(CalcGftFloors(data.scenes, kNewPreGrasp), kNewPreGrasp)) + ".";
    html += Element("p", {{"class", "verdict"}}, text) + DrawChanges(data);
  }
  if (num_findings == 0) return html;
  return html + Element("p", {},
                        LinkTo("findings", FormatCount(static_cast<int>(num_findings), "finding")) +
                            Text(" to read before using the numbers."));
}

}  // namespace

CampaignSection summary_campaign_section() { return {"summary", "Result", DrawSummary}; }

}  // namespace graspbench
