#pragma once
/** @file
The report's plots as inline SVG, without scripts and font files; equal data give equal bytes.

Every plot has a `<title>` and a `<desc>` for screen readers. Colours and strokes come from classes
of assets/style.css, so plots adapt to light, dark and print. Colour is never the only cue: cells
and segments carry text, and marks differ in shape. */

#include <string>
#include <vector>

#include "core/base/units.h"
#include "reports/page/html.h"
#include "reports/plots/svg_parts.h"

namespace graspbench {

/** Rates as a table of shaded cells. */
struct HeatMap {
  struct Cell {
    double rate = 0.0;     ///< 0..1, the cell's shade; NaN: unknown, hatched
    std::string text;      ///< in the cell; empty: no such cell
    std::string hint;      ///< shown on hover
    std::string anchor;    ///< link target; on another page with its name: "a.html#b"
    bool is_gain = false;  ///< shaded in another colour
  };
  PlotText text;
  std::vector<std::string> columns;
  /** A heading over each column, shared by equal neighbours; empty: none. */
  std::vector<std::string> groups = {};
  std::vector<std::string> rows;
  std::vector<Cell> cells;  ///< (rows x columns), row by row
};
Html DrawHeatMap(const HeatMap& map);

/** Bars from 0 to 1 with an interval across their end. */
struct RateBars {
  struct Bar {
    std::string label;
    double rate = 0.0;  ///< NaN: no bar, only the text
    double low = 0.0, high = 0.0;
    std::string text;       ///< below the label
    bool is_total = false;  ///< heads the bars below it
  };
  PlotText text;
  std::vector<Bar> bars;
};
Html DrawRateBars(const RateBars& plot);

/** Class counts as segments of one bar per row; all bars have equal length. */
struct StackedBars {
  struct Class {
    std::string name;
    std::string code;  ///< two letters, shown in its segments
  };
  struct Row {
    std::string label;
    std::string anchor;       ///< where the label leads; empty: nowhere
    std::vector<int> counts;  ///< (classes)
    bool is_total = false;    ///< heads the rows below it
  };
  PlotText text;
  std::vector<Class> classes;  ///< at most 16, the number of fills in the style sheet
  std::vector<Row> rows;
};
Html DrawStackedBars(const StackedBars& plot);

/** Values as dots on a common axis that includes 0: one strip per row, with the median as a
tick. */
struct DotStrips {
  struct Dot {
    double value = 0.0;      ///< NaN: not drawn, counted at the right
    bool is_filled = false;  ///< disc, else a cross
    std::string hint;
  };
  struct Row {
    std::string label;
    std::vector<Dot> dots;   ///< from top to bottom of the strip
    double median = kUnset;  ///< of the drawn values; NaN: no tick
  };
  PlotText text;
  std::string axis;     ///< with unit
  std::string missing;  ///< what a NaN means: "never"
  std::vector<Row> rows;
};
Html DrawDotStrips(const DotStrips& plot);

}  // namespace graspbench
