#include <algorithm>
#include <iterator>

#include "core/base/text/text.h"
#include "datasets/analysis/conditions/sensitivity_summary.h"
#include "reports/page/layout.h"
#include "reports/plots/line_plot.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

Html DrawRates(const std::string& hand, const SensitivitySummary& summary) {
  IntervalPlot plot;
  plot.text.title = "Change of the success rate by single settings, " + hand;
  plot.text.description = "Changes with 95 % intervals, one row per setting.";
  plot.axis = "change of the success rate [percentage points]";
  for (const SettingChange& change : summary.changes) {
    IntervalPlot::Row row;
    row.label = FormatSetting(change.setting);
    row.value = 100.0 * change.rate_change();
    row.low = 100.0 * change.rate_change_low;
    row.high = 100.0 * change.rate_change_high;
    row.text = FormatWithRange(row.value, row.low, row.high, 1);
    row.text +=
        ", " + CountPairs(change) + " pairs of " + FormatCount(change.num_objects, "object");
    if (!change.no_interval.empty()) row.text += ": " + change.no_interval;
    plot.rows.push_back(row);
  }
  return MakeFigure(plot.text.title + ", on the same draws.",
                    "intervals that exclude 0. The number after = is the changed value.",
                    MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

Html DrawMeasures(const std::string& hand, const SensitivitySummary& summary) {
  return MakeDetails(
      "Times, ratios and sigma",
      MakeTable(
          "Mean changes under single settings, " + hand +
              ", with 95 % intervals from resampling objects; pairs in which both trials "
              "have the measure.",
          ShowChanges(summary.changes, {"setting", "was", "pairs", "objects", "improved",
                                        "worsened", "GCT [ms]", "GFT [ms]", "GFT% [%]", "GOT% [%]",
                                        "sigma [N]", "other grasp", "left out"})));
}

Html DrawHands(const ReportData& data, const SensitivitySummary& summary) {
  Html html;
  for (const std::string& hand : data.summary.hands) {
    SensitivitySummary part;
    std::copy_if(summary.changes.begin(), summary.changes.end(), std::back_inserter(part.changes),
                 [&](const SettingChange& change) { return change.hand == hand; });
    if (part.changes.empty()) continue;
    const std::string name = data.models.NameOfHand(hand);
    html += DrawRates(name, part) + DrawMeasures(name, part);
  }
  return html;
}

Html DrawSensitivity(const ReportData& data) {
  if (data.sensitivity.changes.empty()) return Html();
  return MakeParagraph(
             "No data sheet gives placement noise, friction, pads, drives, coupling and arm "
             "stiffness completely. Here one of these parameters at a time has another value, on "
             "the same draws.") +
         DrawHands(data, data.sensitivity);
}

}  // namespace

Section sensitivity_section() {
  return {"sensitivity", "Sensitivity to unmeasured parameters", DrawSensitivity};
}

}  // namespace graspbench
