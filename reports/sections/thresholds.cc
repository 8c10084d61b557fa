#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "reports/page/layout.h"
#include "reports/plots/line_plot.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

Html NameCell(const ReportData& data, const CellThreshold& cell) {
  const auto& cells = data.summary.cells;
  const auto known = std::find_if(cells.begin(), cells.end(), [&](const auto& one) {
    return one.hand == cell.hand && one.object == cell.object && one.grasp == cell.grasp;
  });
  if (known == cells.end()) return Text(cell.hand);
  return LinkTo(known->key, data.models.NameOfHand(cell.hand));
}

Html DrawCellThresholds(const ReportData& data, const ThresholdSummary& summary) {
  std::vector<Html> names;
  for (const CellThreshold& cell : summary.cells) names.push_back(NameCell(data, cell));
  return MakeTable("Grip thresholds of the draws of each condition, as a " +
                       std::string(summary.scale->name) + ".",
                   ShowCells(summary), names);
}

Html DrawMedians(const ReportData& data, const ThresholdSummary& summary) {
  const ThresholdScale& scale = *summary.scale;
  IntervalPlot plot;
  plot.text.title = "Median grip threshold by condition";
  plot.text.description = "Medians with 95 % intervals, one row per hand, object and grasp.";
  plot.axis = std::string("grip threshold, ") + scale.name +
              (*scale.unit ? std::string(" [") + scale.unit + "]" : "");
  const auto finite = [](double value) { return std::isfinite(value) ? value : kUnset; };
  for (const CellThreshold& cell : summary.cells) {
    const std::string label = data.models.NameOfHand(cell.hand) + ", " +
                              data.models.NameOfObject(cell.object) + ", " + cell.grasp;
    plot.rows.push_back({label, finite(cell.median), std::isfinite(cell.high) ? cell.low : kUnset,
                         finite(cell.high), FormatMedian(scale, cell)});
  }
  return MakeFigure(plot.text.title + ".",
                    "conditions far to the right need a strong grip; the text names conditions in "
                    "which half of the draws fail with every grip.",
                    MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

Html DrawThresholds(const ReportData& data) {
  if (data.thresholds.empty()) return Html();
  Html html = MakeParagraph(
      "The grip threshold of a draw is the smallest grip with which its trial succeeds, found by "
      "bisection. It discriminates between hands, grasps and settings where the success rate is at "
      "its ceiling. A margin is a multiple of the smallest contact forces that bear the weight; a "
      "force is the setpoint of each digit that does not oppose the others.");
  for (const ThresholdSummary& summary : data.thresholds) {
    html += DrawMedians(data, summary) + DrawCellThresholds(data, summary);
    const std::string ceilings = DescribeCeilings(summary);
    if (!ceilings.empty()) html += MakeParagraph("Here " + ceilings + ".");
  }
  return html;
}

}  // namespace

Section thresholds_section() {
  return {"thresholds", "The smallest grip that holds", DrawThresholds};
}

}  // namespace graspbench
