#include "reports/plots/svg_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "reports/plots/svg_parts.h"

namespace graspbench {
namespace {

constexpr double kBold = 1.15;  // width of bold headings relative to labels

/** Width of a bold heading. */
double CalcHeadWidth(const std::string& text) {
  return kBold * (CalcLabelWidth({text}) - kPlotGap);
}

/** Breaks a heading into lines of whole words, at most this wide unless one word is wider. */
std::vector<std::string> WrapHead(const std::string& text, double width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool fits = !lines.empty() && CalcHeadWidth(lines.back() + " " + word) <= width;
    fits ? lines.back() += " " + word : lines.emplace_back(word);
  }
  return lines;
}

/** Returns the least width that fits the cells' texts and the words of the headings, so that a map
of two hands fits on a phone. */
double CalcColumnWidth(const HeatMap& map) {
  std::vector<std::string> texts = {"10 / 10"};
  for (const HeatMap::Cell& cell : map.cells) texts.push_back(cell.text);
  double width = CalcLabelWidth(texts) - kPlotGap;
  for (const std::string& column : map.columns) {
    for (const std::string& word : WrapHead(column, 0.0)) {
      width = std::max(width, CalcHeadWidth(word));
    }
  }
  for (size_t c = 0, end = 0; c < map.groups.size(); c = end) {  // a group's name may span few
                                                                 // columns
    while (end < map.groups.size() && map.groups[end] == map.groups[c]) ++end;
    const double room = CalcLabelWidth({map.groups[c]}) + kPlotGap;
    width = std::max(width, room / static_cast<double>(end - c));
  }
  return width;
}

/** Draws slanted lines over a box. */
Html Hatch(double x, double y, double width, double height) {
  constexpr double kStep = 9.0;
  Html lines;
  for (double foot = kStep / 2.0 - height; foot < width; foot += kStep) {
    const double left = std::max(foot, 0.0), right = std::min(foot + height, width);
    lines +=
        Line("hatch", x + left, y + height - (left - foot), x + right, y + height - (right - foot));
  }
  return lines;
}

std::string Numbered(const char* stem, size_t index) { return stem + std::to_string(index); }

}  // namespace

Html DrawHeatMap(const HeatMap& map) {
  GRASPBENCH_DEMAND(map.cells.size() == map.rows.size() * map.columns.size(), map.text.title);
  constexpr double kRow = 26.0, kHeadRow = 28.0, kLine = 16.0, kCellGap = 2.0;
  const double column_width = CalcColumnWidth(map);
  size_t num_lines = 1;
  for (const std::string& column : map.columns) {
    num_lines = std::max(num_lines, WrapHead(column, column_width).size());
  }
  const double head =
      kHeadRow * (map.groups.empty() ? 1.0 : 2.0) + kLine * static_cast<double>(num_lines - 1);
  const double left = CalcLabelWidth(map.rows);
  Html content;
  for (size_t c = 0; c < map.columns.size(); ++c) {
    const double middle = left + column_width * (static_cast<double>(c) + 0.5);
    const std::vector<std::string> lines = WrapHead(map.columns[c], column_width);
    for (size_t i = 0; i < lines.size(); ++i) {
      const double up = kLine * static_cast<double>(lines.size() - 1 - i);
      content += Label("middle head", middle, head - kHeadRow / 2.0 - up, lines[i]);
    }
  }
  for (size_t c = 0, end = 0; c < map.groups.size(); c = end) {
    while (end < map.groups.size() && map.groups[end] == map.groups[c]) ++end;
    const double middle = left + column_width * 0.5 * static_cast<double>(c + end);
    content += Label("middle head", middle, kHeadRow / 2.0, map.groups[c]);
  }
  for (size_t r = 0; r < map.rows.size(); ++r) {
    const double y = head + kRow * static_cast<double>(r);
    content += Label("end", left - kPlotGap, y + kRow / 2.0, map.rows[r]);
    for (size_t c = 0; c < map.columns.size(); ++c) {
      const HeatMap::Cell& cell = map.cells[r * map.columns.size() + c];
      if (cell.text.empty()) continue;
      const double x = left + column_width * static_cast<double>(c);
      const double box_x = x + kCellGap / 2.0, box_y = y + kCellGap / 2.0;
      const double box_width = column_width - kCellGap, box_height = kRow - kCellGap;
      const bool is_known = std::isfinite(cell.rate);
      const std::string css_class = !is_known          ? "heat unknown"
                                    : cell.is_gain     ? "heat gain"
                                    : cell.rate == 0.0 ? "heat zero"
                                                       : "heat";
      const Html box = Element("rect",
                               {{"class", css_class},
                                {"x", Px(box_x)},
                                {"y", Px(box_y)},
                                {"width", Px(box_width)},
                                {"height", Px(box_height)},
                                {"fill-opacity", FormatFixed(is_known ? cell.rate : 0.0, 2)}},
                               Hint(cell.hint));
      content += MaybeLink(cell.anchor,
                           box + (is_known ? Html() : Hatch(box_x, box_y, box_width, box_height)) +
                               Label("middle", x + column_width / 2.0, y + kRow / 2.0, cell.text));
    }
  }
  const double width = left + column_width * static_cast<double>(map.columns.size());
  const double height = head + kRow * static_cast<double>(map.rows.size());
  return Svg("group", width, height, map.text, content);
}

Html DrawRateBars(const RateBars& plot) {
  constexpr double kRow = 36.0, kBar = 16.0, kAxis = 24.0, kPlot = 300.0, kCap = 4.0, kLine = 16.0;
  std::vector<std::string> labels, texts;
  for (const RateBars::Bar& bar : plot.bars) {
    labels.push_back(bar.label);
    texts.push_back(bar.text);
  }
  // The numbers stand below the labels, where they are also visible on a phone.
  const double left = std::max(kBold * CalcLabelWidth(labels), CalcLabelWidth(texts)) + kPlotGap;
  const double bottom = kRow * static_cast<double>(plot.bars.size());
  Html content;
  for (int tick = 0; tick <= 4; ++tick) {
    const double x = left + kPlot * tick / 4.0;
    content += Line("grid", x, 0.0, x, bottom);
    content += Label("middle small", x, bottom + kAxis / 2.0, std::to_string(25 * tick) + " %");
  }
  for (size_t i = 0; i < plot.bars.size(); ++i) {
    const RateBars::Bar& bar = plot.bars[i];
    const double y = kRow * (static_cast<double>(i) + 0.5);
    content +=
        Label(bar.is_total ? "end head" : "end", left - kPlotGap, y - kLine / 2.0, bar.label);
    content += Label("end small", left - kPlotGap, y + kLine / 2.0, bar.text);
    if (!std::isfinite(bar.rate)) continue;
    const double low = left + kPlot * bar.low, high = left + kPlot * bar.high;
    content += Rect("bar", left, y - kBar / 2.0, kPlot * bar.rate, kBar);
    content += Line("interval", low, y, high, y);
    content += Line("interval", low, y - kCap, low, y + kCap);
    content += Line("interval", high, y - kCap, high, y + kCap);
  }
  return Svg("img", left + kPlot + 3.0 * kPlotGap, bottom + kAxis, plot.text, content);
}

Html DrawStackedBars(const StackedBars& plot) {
  constexpr double kRow = 22.0, kBar = 18.0, kPlot = 720.0, kTextNeeds = 30.0, kLegendRow = 20.0;
  constexpr size_t kLegendColumns = 4;
  std::vector<std::string> labels, totals;
  for (const StackedBars::Row& row : plot.rows) {
    (row.is_total ? totals : labels).push_back(row.label);
  }
  const double left = std::max(CalcLabelWidth(labels), kBold * CalcLabelWidth(totals)) + kPlotGap;
  const double width = left + kPlot;
  Html content;
  size_t num_shown = 0;
  for (size_t k = 0; k < plot.classes.size(); ++k) {
    const bool occurs = std::any_of(plot.rows.begin(), plot.rows.end(), [k](const auto& row) {
      return k < row.counts.size() && row.counts[k] > 0;
    });
    if (!occurs) continue;
    const double x = width / kLegendColumns * static_cast<double>(num_shown % kLegendColumns);
    const size_t legend_row = num_shown++ / kLegendColumns;
    const double y = kLegendRow * static_cast<double>(legend_row);
    content += Rect(Numbered("part part", k), x, y, kTextNeeds, kLegendRow - 4.0);
    content += Label("middle small", x + kTextNeeds / 2.0, y + kLegendRow / 2.0 - 2.0,
                     plot.classes[k].code);
    content += Label("start small", x + kTextNeeds + kPlotGap, y + kLegendRow / 2.0 - 2.0,
                     plot.classes[k].name);
  }
  const size_t num_legend_rows = (num_shown + kLegendColumns - 1) / kLegendColumns;
  const double top = kLegendRow * static_cast<double>(num_legend_rows) + kPlotGap;
  for (size_t r = 0; r < plot.rows.size(); ++r) {
    const StackedBars::Row& row = plot.rows[r];
    GRASPBENCH_DEMAND(row.counts.size() == plot.classes.size(), row.label);
    const double y = top + kRow * static_cast<double>(r);
    content += MaybeLink(row.anchor, Label(row.is_total ? "end head" : "end", left - kPlotGap,
                                           y + kRow / 2.0, row.label));
    int total = 0;
    for (int count : row.counts) total += count;
    double x = left;
    for (size_t k = 0; k < plot.classes.size(); ++k) {
      if (row.counts[k] == 0) continue;
      const double part = kPlot * row.counts[k] / total;
      const std::string count = std::to_string(row.counts[k]);
      content += Rect(Numbered("part part", k), x, y + (kRow - kBar) / 2.0, part, kBar,
                      plot.classes[k].name + ": " + count);
      if (part >= kTextNeeds) {
        content += Label("middle small", x + part / 2.0, y + kRow / 2.0,
                         plot.classes[k].code + " " + count);
      }
      x += part;
    }
    if (total == 0) content += Label("start small", left, y + kRow / 2.0, "no trial finished");
  }
  const double height = top + kRow * static_cast<double>(plot.rows.size());
  return Svg("group", width, height, plot.text, content);
}

namespace {

Html DrawDot(const DotStrips::Dot& dot, double x, double y) {
  constexpr double kRadius = 3.2;
  if (dot.is_filled) {
    return Element("circle", {{"class", "dot"}, {"cx", Px(x)}, {"cy", Px(y)}, {"r", Px(kRadius)}},
                   Hint(dot.hint));
  }
  return Element(
      "path",
      {{"class", "cross"},
       {"d", "M" + Px(x - kRadius) + " " + Px(y - kRadius) + "l6.4 6.4m0 -6.4l-6.4 6.4"}},
      Hint(dot.hint));
}

}  // namespace

Html DrawDotStrips(const DotStrips& plot) {
  constexpr double kRow = 34.0, kSpread = 20.0, kAxis = 38.0, kPlot = 320.0;
  std::vector<std::string> labels;
  double lowest = 0.0, highest = 0.0;
  for (const DotStrips::Row& row : plot.rows) {
    labels.push_back(row.label);
    for (const DotStrips::Dot& dot : row.dots) {
      if (!std::isfinite(dot.value)) continue;
      lowest = std::min(lowest, dot.value);
      highest = std::max(highest, dot.value);
    }
  }
  const Axis axis(lowest, highest, 5);
  const double left = CalcLabelWidth(labels) + kPlotGap;
  const double bottom = kRow * static_cast<double>(plot.rows.size());

  const auto place_x = [&](double value) { return left + kPlot * axis.CalcShare(value); };

  Html content;
  for (const Axis::Tick& tick : axis.ticks()) {
    const double x = place_x(tick.value);
    content += Line(tick.value == 0.0 ? "grid zero" : "grid", x, 0.0, x, bottom);
    content += Label("middle small", x, bottom + 11.0, tick.text);
  }
  content += Label("middle small", left + kPlot / 2.0, bottom + 28.0, plot.axis);
  for (size_t r = 0; r < plot.rows.size(); ++r) {
    const DotStrips::Row& row = plot.rows[r];
    const double middle = kRow * (static_cast<double>(r) + 0.5);
    content += Label("end", left - kPlotGap, middle, row.label);
    if (r > 0) content += Line("grid", left, kRow * r, left + kPlot, kRow * r);
    int num_missing = 0;
    for (size_t i = 0; i < row.dots.size(); ++i) {
      const DotStrips::Dot& dot = row.dots[i];
      if (!std::isfinite(dot.value)) {
        ++num_missing;
        continue;
      }
      const double x = place_x(dot.value);
      const double place = (static_cast<double>(i) + 0.5) / static_cast<double>(row.dots.size());
      const double y = middle + kSpread * (place - 0.5);
      content += DrawDot(dot, x, y);
    }
    if (std::isfinite(row.median)) {
      const double x = place_x(row.median);
      content += Line("median", x, middle - kRow / 2.0 + 3.0, x, middle + kRow / 2.0 - 3.0);
    }
    if (num_missing > 0) {
      content += Label("start small", left + kPlot + kPlotGap, middle,
                       std::to_string(num_missing) + " " + plot.missing);
    }
  }
  const double width = left + kPlot + kPlotGap + CalcLabelWidth({"999 " + plot.missing});
  return Svg("img", width, bottom + kAxis, plot.text, content);
}

}  // namespace graspbench
