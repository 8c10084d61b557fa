#include <cmath>

#include "core/base/text.h"
#include "reports/line_plot.h"
#include "reports/study/study_format.h"
#include "reports/study/study_section.h"

namespace graspbench {
namespace {

/** Bars of the figure: those whose lengths let conditions be compared by eye. */
constexpr BarKind kDrawnBars = BarKind::kLoftusMasson;

Html DrawCells(const MeasureStatistics& statistics, size_t series) {
  IntervalPlot plot;
  plot.text.title = statistics.measure.name;
  plot.axis = FormatHead(statistics.measure);
  const DisplayUnit unit = FindDisplayUnit(statistics.measure.unit);
  const std::vector<std::string> cells = ListCells(statistics.table.factors);
  std::string kind = "no bars: ";
  Answer<Eigen::VectorXd> bars(statistics.cells.none());
  if (statistics.cells) bars = CalcHalfWidths(*statistics.cells, kDrawnBars);
  if (statistics.cells && !bars) {
    kind += bars.reason();
    bars = CalcHalfWidths(*statistics.cells, BarKind::kBetweenPerson);
    if (bars) kind = std::string(NameOf(BarKind::kBetweenPerson));
  } else if (bars) {
    kind = std::string(NameOf(kDrawnBars));
  } else {
    kind += statistics.cells.reason();
  }
  for (size_t cell = 0; cell < cells.size(); ++cell) {
    IntervalPlot::Row row;
    row.label = NameOfCell(cells[cell]);
    row.series = static_cast<int>(series % 8);
    const auto column = static_cast<Eigen::Index>(cell);
    const Answer<Summary>& trials = statistics.by_cell[cell];
    const double mean = statistics.cells ? statistics.cells->means.col(column).mean()
                        : trials         ? trials->mean
                                         : std::nan("");
    row.value = mean * unit.factor;
    row.low = row.high = std::nan("");
    if (bars) {
      row.low = (mean - (*bars)[column]) * unit.factor;
      row.high = (mean + (*bars)[column]) * unit.factor;
    }
    row.text = FormatWithUnit(mean, statistics.measure.unit) + ", " +
               FormatCount(trials ? trials->count : 0, "trial");
    plot.rows.push_back(row);
  }
  plot.text.description = "Mean of each condition with its interval.";
  return MakeFigure(
      std::string(statistics.measure.name) + DescribeFactors(statistics.table.factors) +
          ": mean over people of their means. " + "Bars: " + kind + ".",
      "the order of the conditions; whether two differ stands under Tests and trends.",
      MakeScroll(statistics.measure.name, DrawIntervalPlot(plot)));
}

/** All four kinds of bars, so that nobody has to trust the choice of one. */
Html DrawBarTable(const MeasureStatistics& statistics) {
  if (!statistics.cells) return {};
  std::vector<Column> columns = {{"Condition"}, {"Mean", Align::kNumber}};
  std::vector<Answer<Eigen::VectorXd>> bars;
  for (const BarKind kind : ListBarKinds()) {
    columns.push_back({std::string(NameOf(kind)), Align::kNumber, "half the length of the bar"});
    bars.push_back(CalcHalfWidths(*statistics.cells, kind));
  }
  Table table("Half-lengths of all kinds of error bars, " + FormatHead(statistics.measure) + ".",
              columns);
  const CellMeans& cells = *statistics.cells;
  for (size_t cell = 0; cell < cells.cells.size(); ++cell) {
    const auto column = static_cast<Eigen::Index>(cell);
    std::vector<Html> row = {
        Text(NameOfCell(cells.cells[cell])),
        Text(FormatValue(cells.means.col(column).mean(), statistics.measure.unit))};
    for (const Answer<Eigen::VectorXd>& widths : bars) {
      row.push_back(Text(widths ? FormatValue((*widths)[column], statistics.measure.unit) : "n/a"));
    }
    table.AddRow(row);
  }
  return MakeDetails("All kinds of error bars", table.ToHtml());
}

Html Draw(const StudyPageData& data) {
  Html html;
  size_t series = 0;
  for (const MeasureStatistics& statistics : data.result.statistics.measures) {
    html += Element("h3", {}, statistics.measure.name) + DrawCells(statistics, series++) +
            DrawBarTable(statistics);
  }
  return html;
}

}  // namespace

StudySection measures_study_section() { return {"measures", "Measures by condition", Draw}; }

}  // namespace graspbench
