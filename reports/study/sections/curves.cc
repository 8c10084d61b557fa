#include "core/base/text/text.h"
#include "human_study/study/run/trial_removal.h"
#include "reports/plots/line_plot.h"
#include "reports/study/study_format.h"
#include "reports/study/trial_figures.h"

namespace graspbench {
namespace {

constexpr size_t kMaxCurves = 8;  // number of curves that a line plot can distinguish

Html DrawCurves(const StudyPageData& data) {
  const std::vector<OpeningCurve>& curves = data.result.statistics.curves;
  const HandOpening& opening = FindHandOpening(data.result.study.config.analysis.opening.measure);
  LinePlot plot;
  plot.text.title = "Hand opening over the reach";
  plot.x_axis = "share of the time from onset to last contact [%]";
  plot.y_axis = MakeWords(opening.id) + " [mm]";
  plot.is_y_from_zero = false;
  const DisplayUnit mm = FindDisplayUnit("m");
  const auto in_mm = [&](std::vector<double> values) {
    for (double& value : values) value *= mm.factor;
    return values;
  };
  size_t num_without = 0;
  for (const OpeningCurve& curve : curves) {
    if (curve.num_trials == 0) {
      ++num_without;
      continue;
    }
    if (plot.series.size() == kMaxCurves) break;
    LinePlot::Series series;
    series.label = NameOfCell(curve.cell, data.result.study.factors) + " (" +
                   FormatCount(curve.num_trials, "trial") + ")";
    for (const double time : curve.times) series.x.push_back(100.0 * time);
    series.y = in_mm(curve.mean);
    series.low = in_mm(curve.low);
    series.high = in_mm(curve.high);
    plot.series.push_back(series);
  }
  if (plot.series.empty()) return MakeParagraph("No trial is included, so there is no curve.");
  plot.text.description =
      "Mean hand opening of each condition from the onset of the movement to the last contact.";
  Html html;
  if (curves.size() - num_without > kMaxCurves) {
    html += MakeParagraph("Of " + std::to_string(curves.size()) + " conditions the first " +
                          std::to_string(kMaxCurves) + " are drawn.");
  }
  return html +
         MakeFigure("Mean opening of each condition (" + MakeWords(opening.id) + ")" +
                        DescribeFactors(data.result.study.factors) +
                        ", from the onset of the movement to the last contact; bands are one "
                        "standard deviation over trials.",
                    "a rise to the peak opening at 60 to 80 % and a fall to the object size; "
                    "curves of larger objects lie higher.",
                    MakeScroll("Hand opening over the reach", DrawLinePlot(plot)));
}

/** Shows the events on one included trial. */
Html DrawGoodTrial(const StudyResult& result) {
  const StudyTrial* trial = FindGoodTrial(result);
  if (trial == nullptr) return {};
  const std::string flags = FormatFlags(*trial->analysis);
  const ContactTiming& timing = trial->analysis->timing;
  return MakeFigure(
      "One included trial, " + trial->id + (flags.empty() ? "" : " (" + flags + ")") +
          ": the hand starts (onset), reaches its peak opening (widest), its digits touch, and the "
          "object leaves the table (lift-off).",
      "GFT, first to last touch, is " + FormatWithUnit(timing.gft, "s") +
          " here; GOT, thumb to the "
          "first finger, " +
          FormatWithUnit(timing.got, "s") +
          "; GCT, widest opening to the last "
          "touch, " +
          FormatWithUnit(timing.gct, "s") + ".",
      Element("div", {{"class", "pair"}},
              Element("div", {}, DrawTrialSpeed(*trial, result.study.config.analysis.movement)) +
                  Element("div", {}, DrawTrialOpening(*trial))));
}

Html DrawSection(const StudyPageData& data) {
  return DrawCurves(data) + DrawGoodTrial(data.result);
}

}  // namespace

StudySection curves_study_section() {
  return {"curves", "Hand opening over the reach", DrawSection};
}

}  // namespace graspbench
