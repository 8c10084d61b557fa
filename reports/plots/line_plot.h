#pragma once
/** @file
Plots over continuous axes: curves with bands, estimates with intervals, and timelines. Inline SVG
by the same rules as svg_plot.h. */

#include <string>
#include <utility>
#include <vector>

#include "reports/page/html.h"
#include "reports/plots/svg_parts.h"

namespace graspbench {

/** Curves on common axes; the axes follow the finite values. */
struct LinePlot {
  struct Series {
    std::string label;
    std::vector<double> x, y;       ///< of equal length; a NaN interrupts the curve
    std::vector<double> low, high;  ///< band about y; both empty: none
  };
  struct Mark {
    double x = 0.0;
    std::string label;
  };
  PlotText text;
  std::string x_axis, y_axis;  ///< with units
  std::vector<Series> series;  ///< at most 8, distinguished by colour and dashes
  std::vector<Mark> marks;     ///< vertical lines
  bool is_y_from_zero = true;  ///< the y axis includes 0
  bool has_cursor = false;     ///< a vertical line moved by a script; invisible without it
};
Html DrawLinePlot(const LinePlot& plot);

/** Estimates with their intervals, one row each, on a common axis. */
struct IntervalPlot {
  struct Row {
    std::string label;
    double value = 0.0;                ///< NaN: no mark, only the text
    double low = 0.0, high = 0.0;      ///< NaN: no interval
    std::string text;                  ///< beside the row
    std::string anchor = {};           ///< where the label leads; empty: nowhere
    int series = 0;                    ///< 0..7, the mark's colour
    bool is_heading = false;           ///< a label without a value, above the rows that follow
    std::vector<double> singles = {};  ///< single values behind the estimate, as ticks; NaN: none
  };
  PlotText text;
  std::string axis;  ///< with unit
  bool holds_zero = true;
  bool labels_above = false;          ///< labels above their intervals: fits a narrow screen
  std::vector<LinePlot::Mark> marks;  ///< vertical lines
  std::vector<Row> rows;

  void AddHeading(const std::string& label) {
    rows.emplace_back().label = label;
    rows.back().is_heading = true;
  }
};
Html DrawIntervalPlot(const IntervalPlot& plot);

/** A timeline: rows of spans and marks over time, with phases as columns behind them. */
struct StripChart {
  struct Span {
    double from = 0.0, to = 0.0;
    int kind = 0;  ///< 0..7: fill; see `kinds`
    std::string hint;
  };
  struct Mark {
    double at = 0.0;
    std::string symbol;  ///< one or two letters at this time, or after the previous mark
    std::string hint;
  };
  struct Row {
    std::string label;
    std::vector<Span> spans;
    std::vector<Mark> marks;
  };
  struct Phase {
    double from = 0.0, to = 0.0;
    std::string label;
  };
  PlotText text;
  std::string axis;                ///< "time since the start of closure [s]"
  std::vector<std::string> kinds;  ///< legend of the fills; at most 8
  std::vector<std::pair<std::string, std::string>> symbols;  ///< of the marks: "o", "surface"
  std::vector<Phase> phases;
  std::vector<Row> rows;
};
Html DrawStripChart(const StripChart& chart);

}  // namespace graspbench
