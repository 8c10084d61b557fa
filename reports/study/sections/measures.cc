#include <cmath>

#include "core/base/text.h"
#include "human_study/study/condition_estimates.h"
#include "reports/line_plot.h"
#include "reports/study/study_format.h"
#include "reports/study/study_section.h"

namespace graspbench {
namespace {

Html DrawCells(const MeasureStatistics& statistics, const ConditionEstimates& estimates,
               size_t series) {
  IntervalPlot plot;
  plot.text.title = statistics.measure.name;
  plot.axis = FormatHead(statistics.measure);
  const DisplayUnit unit = FindDisplayUnit(statistics.measure.unit);
  for (size_t cell = 0; cell < estimates.cells.size(); ++cell) {
    IntervalPlot::Row row;
    row.label = NameOfCell(estimates.cells[cell], statistics.table.factors);
    row.series = static_cast<int>(series % 8);
    const double mean = estimates.means[cell];
    row.value = mean * unit.factor;
    row.low = row.high = std::nan("");
    if (estimates.drawn) {
      const Interval interval = estimates.drawn_interval(cell);
      row.low = interval.low * unit.factor;
      row.high = interval.high * unit.factor;
    }
    row.text = FormatWithUnit(mean, statistics.measure.unit) + ", " +
               FormatCount(estimates.num_trials[cell], "trial");
    plot.rows.push_back(row);
  }
  plot.text.description = "Mean of each condition with its interval.";
  return MakeFigure(
      std::string(statistics.measure.name) + DescribeFactors(statistics.table.factors) +
          ": mean over people of their means. " + "Bars: " + estimates.drawn_kind + ".",
      "the order of the conditions; whether two differ stands under Tests and trends.",
      MakeScroll(statistics.measure.name, DrawIntervalPlot(plot)));
}

/** All four kinds of bars, so that nobody has to trust the choice of one. */
Html DrawBarTable(const MeasureStatistics& statistics, const ConditionEstimates& estimates) {
  if (!statistics.cells) return {};
  std::vector<Column> columns = {{"Condition"}, {"Mean", Align::kNumber}};
  for (const BarKind kind : ListBarKinds()) {
    columns.push_back({std::string(NameOf(kind)), Align::kNumber, "half the length of the bar"});
  }
  Table table("Half-lengths of all kinds of error bars, " + FormatHead(statistics.measure) + ".",
              columns);
  const std::string unit = statistics.measure.unit;
  for (size_t cell = 0; cell < estimates.cells.size(); ++cell) {
    std::vector<Html> row = {Text(NameOfCell(estimates.cells[cell], statistics.table.factors)),
                             Text(FormatValue(estimates.means[cell], unit))};
    for (const Answer<Eigen::VectorXd>& widths : estimates.half_widths) {
      row.push_back(
          Text(widths ? FormatValue((*widths)[static_cast<Eigen::Index>(cell)], unit) : "n/a"));
    }
    table.AddRow(row);
  }
  return MakeDetails("All kinds of error bars", table.ToHtml());
}

Html DrawMeasures(const StudyPageData& data) {
  Html html;
  size_t series = 0;
  for (const MeasureStatistics& statistics : data.result.statistics.measures) {
    const ConditionEstimates estimates = CalcConditionEstimates(statistics);
    html += Element("h3", {}, statistics.measure.name) +
            DrawCells(statistics, estimates, series++) + DrawBarTable(statistics, estimates);
  }
  return html;
}

}  // namespace

StudySection measures_study_section() {
  return {"measures", "Measures by condition", DrawMeasures};
}

}  // namespace graspbench
