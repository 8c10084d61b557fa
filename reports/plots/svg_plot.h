#pragma once
/** @file
The report's plots as inline SVG: no script, no font files, the same data give the same bytes.

Every plot has a `<title>` and a `<desc>` for people who cannot see it. Colours and strokes come from
classes of assets/style.css, so plots follow light, dark and print. Colour is never the only sign:
cells and segments carry text, marks differ in shape. */

#include <string>
#include <vector>

#include "core/base/units.h"
#include "reports/page/html.h"
#include "reports/plots/svg_parts.h"

namespace graspbench {

/** Rates as a table of shaded cells. */
struct HeatMap {
  struct Cell {
    double rate = 0.0;     ///< 0..1 shades the cell; NaN: nothing known, hatched
    std::string text;      ///< in the cell; empty: no such cell
    std::string hint;      ///< shown when pointed at
    std::string anchor;    ///< where the cell leads; with the page where it is another: "a.html#b"
    bool is_gain = false;  ///< shaded in another colour
  };
  PlotText text;
  std::vector<std::string> columns;
  /** One over each column, equal neighbours share it; empty: none. */
  std::vector<std::string> groups = {};
  std::vector<std::string> rows;
  std::vector<Cell> cells;  ///< (rows x columns), row by row
};
Html DrawHeatMap(const HeatMap& map);

/** Bars from 0 to 1 with an interval across their end. */
struct RateBars {
  struct Bar {
    std::string label;
    double rate = 0.0;  ///< NaN: no bar, the text alone
    double low = 0.0, high = 0.0;
    std::string text;       ///< below the label
    bool is_total = false;  ///< heads the bars below it
  };
  PlotText text;
  std::vector<Bar> bars;
};
Html DrawRateBars(const RateBars& plot);

/** Counts of classes as parts of one bar per row, all bars equally long. */
struct StackedBars {
  struct Class {
    std::string name;
    std::string code;  ///< two letters, written into its parts
  };
  struct Row {
    std::string label;
    std::string anchor;       ///< where the label leads; empty: nowhere
    std::vector<int> counts;  ///< (classes)
    bool is_total = false;    ///< heads the rows below it
  };
  PlotText text;
  std::vector<Class> classes;  ///< at most 16: the style sheet has as many fills
  std::vector<Row> rows;
};
Html DrawStackedBars(const StackedBars& plot);

/** Values as dots on a common axis that holds 0, one strip per row, the median as a tick. */
struct DotStrips {
  struct Dot {
    double value = 0.0;      ///< NaN: counted at the right, not drawn
    bool is_filled = false;  ///< disc, else a cross
    std::string hint;
  };
  struct Row {
    std::string label;
    std::vector<Dot> dots;   ///< from top to bottom of the strip
    double median = kUnset;  ///< of those that are drawn; NaN: no tick
  };
  PlotText text;
  std::string axis;     ///< with unit
  std::string missing;  ///< what a NaN means: "never"
  std::vector<Row> rows;
};
Html DrawDotStrips(const DotStrips& plot);

}  // namespace graspbench
