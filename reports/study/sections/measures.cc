#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "human_study/study/inference/measure_statistics.h"
#include "reports/plots/line_plot.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

/** Lists the values of a cell's trials. */
std::vector<double> ListSingles(const MeasureTable& table, const std::vector<std::string>& levels,
                                double factor) {
  std::vector<double> values;
  for (const Observation& row : table.rows) {
    if (row.levels == levels) values.push_back(factor * row.value);
  }
  return values;
}

Html DrawCells(const MeasureStatistics& statistics, const ConditionEstimates& estimates,
               const std::string& bars, size_t series) {
  IntervalPlot plot;
  plot.text.title = statistics.measure.name;
  plot.axis = FormatHead(statistics.measure);
  const DisplayUnit unit = FindDisplayUnit(statistics.measure.unit);
  const std::vector<std::vector<std::string>> levels = ListLevels(statistics.table.factors);
  for (size_t cell = 0; cell < estimates.cells.size(); ++cell) {
    IntervalPlot::Row row;
    row.singles = ListSingles(statistics.table, levels[cell], unit.factor);
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
  plot.text.description = "Mean of each condition with its interval, and all trials.";
  return MakeFigure(
      std::string(statistics.measure.name) + DescribeFactors(statistics.table.factors) +
          (bars == estimates.drawn_kind ? "." : ". Bars: " + estimates.drawn_kind + "."),
      "", MakeScroll(statistics.measure.name, DrawIntervalPlot(plot)));
}

/** Tabulates all four kinds of error bars, so that the reader need not rely on one choice. */
Html DrawBarTable(const MeasureStatistics& statistics, const ConditionEstimates& estimates) {
  const std::vector<Answer<Eigen::VectorXd>>& widths = estimates.half_widths;
  const bool has_bars = std::any_of(widths.begin(), widths.end(),
                                    [](const auto& answer) { return answer.has_value(); });
  if (!has_bars) return {};  // the figure gives the reason
  std::vector<Column> columns = {"Condition", "Mean"};
  std::vector<std::string> without;
  for (size_t i = 0; i < widths.size(); ++i) {
    const std::string name(NameOf(ListBarKinds()[i]));
    if (widths[i]) {
      columns.push_back({name, "half the length of the bar"});
    } else {
      without.push_back(name + ": none, " + widths[i].reason());
    }
  }
  Table table("Half-lengths of all kinds of error bars, " + FormatHead(statistics.measure) + ".",
              columns);
  const std::string unit = statistics.measure.unit;
  for (size_t cell = 0; cell < estimates.cells.size(); ++cell) {
    std::vector<Cell> row = {NameOfCell(estimates.cells[cell], statistics.table.factors),
                             FormatValue(estimates.means[cell], unit)};
    for (const Answer<Eigen::VectorXd>& answer : widths) {
      if (!answer) continue;
      row.push_back(FormatValue((*answer)[static_cast<Eigen::Index>(cell)], unit));
    }
    table.AddRow(row);
  }
  return MakeDetails("All kinds of error bars",
                     without.empty() ? table.ToHtml() : table.ToHtml() + MakeList(without));
}

Html DrawMeasures(const StudyPageData& data) {
  Html html;
  size_t series = 0;
  std::string bars;  // kind of the first measure's bars; stated once for all measures with the same
                     // kind
  for (const MeasureStatistics& statistics : data.result.statistics.measures) {
    const ConditionEstimates estimates = CalcConditionEstimates(statistics);
    if (series == 0) {
      bars = estimates.drawn_kind;
      html += MakeParagraph(
          "Dots are means over persons of their means, ticks are single trials. Bars: " + bars +
          ". Look for outlying trials and for the order of the conditions; see Tests and trends "
          "for significance.");
    }
    html += Element("h3", {}, statistics.measure.name) +
            DrawCells(statistics, estimates, bars, series++) + DrawBarTable(statistics, estimates);
  }
  return html;
}

}  // namespace

StudySection measures_study_section() {
  return {"measures", "Measures by condition", DrawMeasures};
}

}  // namespace graspbench
