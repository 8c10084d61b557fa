#include "reports/svg_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "reports/format.h"
#include "reports/session_summary.h"

namespace graspbench {
namespace {

// Plots are drawn in CSS pixels. Letters of the 13 px labels are about this wide.
constexpr double kLetterWidth = 7.4;
constexpr double kMaxLabelWidth = 230.0;
constexpr double kGap = 8.0;

std::string Px(double value) { return FormatFixed(value, 1); }

Html Hint(const std::string& text) { return text.empty() ? Html() : Element("title", {}, text); }

Html Rect(const std::string& css_class, double x, double y, double width, double height,
          const std::string& hint = {}) {
  return Element("rect",
                 {{"class", css_class},
                  {"x", Px(x)},
                  {"y", Px(y)},
                  {"width", Px(width)},
                  {"height", Px(height)}},
                 Hint(hint));
}

Html Line(const std::string& css_class, double x1, double y1, double x2, double y2) {
  return Element(
      "line",
      {{"class", css_class}, {"x1", Px(x1)}, {"y1", Px(y1)}, {"x2", Px(x2)}, {"y2", Px(y2)}});
}

/** Text centred about y in height; css_class says where x is: "start", "middle" or "end". */
Html Label(const std::string& css_class, double x, double y, const std::string& text) {
  return Element("text", {{"class", css_class}, {"x", Px(x)}, {"y", Px(y)}}, text);
}

Html MaybeLink(const std::string& anchor, const Html& content) {
  return anchor.empty() ? content : Element("a", {{"href", "#" + anchor}}, content);
}

double CalcLabelWidth(const std::vector<std::string>& labels) {
  size_t longest = 0;
  for (const std::string& label : labels) longest = std::max(longest, label.size());
  return std::min(kMaxLabelWidth, kLetterWidth * static_cast<double>(longest) + kGap);
}

/** The links of an "img" are hidden from screen readers, so a plot with links is a "group". */
Html Svg(const char* role, double width, double height, const PlotText& text, const Html& content) {
  const std::string whole_width = FormatFixed(std::ceil(width), 0);
  const std::string whole_height = FormatFixed(std::ceil(height), 0);
  return Element(
      "svg",
      {{"class", "plot"},
       {"role", role},
       {"viewBox", "0 0 " + whole_width + " " + whole_height},
       {"width", whole_width},
       {"height", whole_height}},
      Element("title", {}, text.title) + Element("desc", {}, text.description) + content);
}

std::string Numbered(const char* stem, size_t index) { return stem + std::to_string(index); }

}  // namespace

double CalcTickStep(double range, int count) {
  GRASPBENCH_DEMAND(range > 0.0 && count > 0, std::to_string(range));
  const double power = std::pow(10.0, std::floor(std::log10(range / count)));
  for (double factor : {1.0, 2.0, 5.0}) {
    if (range / (factor * power) <= count) return factor * power;
  }
  return 10.0 * power;
}

Html DrawHeatMap(const HeatMap& map) {
  GRASPBENCH_DEMAND(map.cells.size() == map.rows.size() * map.columns.size(), map.text.title);
  constexpr double kRow = 26.0, kHead = 28.0, kCellGap = 2.0;
  const double column_width = std::clamp(CalcLabelWidth(map.columns) + kGap, 84.0, 180.0);
  const double left = CalcLabelWidth(map.rows) + kGap;
  Html content;
  for (size_t c = 0; c < map.columns.size(); ++c) {
    const double middle = left + column_width * (static_cast<double>(c) + 0.5);
    content += Label("middle head", middle, kHead / 2.0, map.columns[c]);
  }
  for (size_t r = 0; r < map.rows.size(); ++r) {
    const double y = kHead + kRow * static_cast<double>(r);
    content += Label("end", left - kGap, y + kRow / 2.0, map.rows[r]);
    for (size_t c = 0; c < map.columns.size(); ++c) {
      const HeatMap::Cell& cell = map.cells[r * map.columns.size() + c];
      if (cell.text.empty()) continue;
      const double x = left + column_width * static_cast<double>(c);
      const bool is_known = std::isfinite(cell.rate);
      const std::string css_class = !is_known          ? "heat unknown"
                                    : cell.rate == 0.0 ? "heat zero"
                                                       : "heat";
      const Html box = Element("rect",
                               {{"class", css_class},
                                {"x", Px(x + kCellGap / 2.0)},
                                {"y", Px(y + kCellGap / 2.0)},
                                {"width", Px(column_width - kCellGap)},
                                {"height", Px(kRow - kCellGap)},
                                {"fill-opacity", FormatFixed(is_known ? cell.rate : 0.0, 2)}},
                               Hint(cell.hint));
      content += MaybeLink(
          cell.anchor, box + Label("middle", x + column_width / 2.0, y + kRow / 2.0, cell.text));
    }
  }
  const double width = left + column_width * static_cast<double>(map.columns.size());
  const double height = kHead + kRow * static_cast<double>(map.rows.size());
  return Svg("group", width, height, map.text, content);
}

Html DrawRateBars(const RateBars& plot) {
  constexpr double kRow = 30.0, kBar = 14.0, kAxis = 24.0, kPlot = 300.0, kCap = 4.0;
  std::vector<std::string> labels, texts;
  for (const RateBars::Bar& bar : plot.bars) {
    labels.push_back(bar.label);
    texts.push_back(bar.text);
  }
  const double left = CalcLabelWidth(labels) + kGap;
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
    content += Label(bar.is_total ? "end head" : "end", left - kGap, y, bar.label);
    content += Label("start", left + kPlot + 2.0 * kGap, y, bar.text);
    if (!std::isfinite(bar.rate)) continue;
    const double low = left + kPlot * bar.low, high = left + kPlot * bar.high;
    content += Rect("bar", left, y - kBar / 2.0, kPlot * bar.rate, kBar);
    content += Line("interval", low, y, high, y);
    content += Line("interval", low, y - kCap, low, y + kCap);
    content += Line("interval", high, y - kCap, high, y + kCap);
  }
  const double width = left + kPlot + 2.0 * kGap + CalcLabelWidth(texts);
  return Svg("img", width, bottom + kAxis, plot.text, content);
}

Html DrawStackedBars(const StackedBars& plot) {
  constexpr double kRow = 22.0, kBar = 18.0, kPlot = 460.0, kTextNeeds = 30.0, kLegendRow = 20.0;
  constexpr size_t kLegendColumns = 3;
  std::vector<std::string> labels;
  for (const StackedBars::Row& row : plot.rows) labels.push_back(row.label);
  const double left = CalcLabelWidth(labels) + kGap;
  const double width = left + kPlot;
  Html content;
  for (size_t k = 0; k < plot.classes.size(); ++k) {
    const double x = width / kLegendColumns * static_cast<double>(k % kLegendColumns);
    const double y = kLegendRow * static_cast<double>(k / kLegendColumns);
    content += Rect(Numbered("part part", k), x, y, kTextNeeds, kLegendRow - 4.0);
    content += Label("middle small", x + kTextNeeds / 2.0, y + kLegendRow / 2.0 - 2.0,
                     plot.classes[k].code);
    content += Label("start small", x + kTextNeeds + kGap, y + kLegendRow / 2.0 - 2.0,
                     plot.classes[k].name);
  }
  const size_t num_legend_rows = (plot.classes.size() + kLegendColumns - 1) / kLegendColumns;
  const double top = kLegendRow * static_cast<double>(num_legend_rows) + kGap;
  for (size_t r = 0; r < plot.rows.size(); ++r) {
    const StackedBars::Row& row = plot.rows[r];
    GRASPBENCH_DEMAND(row.counts.size() == plot.classes.size(), row.label);
    const double y = top + kRow * static_cast<double>(r);
    content += MaybeLink(row.anchor, Label("end", left - kGap, y + kRow / 2.0, row.label));
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

Html DrawDotStrips(const DotStrips& plot) {
  constexpr double kRow = 34.0, kSpread = 20.0, kAxis = 38.0, kPlot = 320.0, kDot = 3.2;
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
  const double step = CalcTickStep(highest > lowest ? highest - lowest : 1.0, 5);
  const int first_tick = static_cast<int>(std::floor(lowest / step + 1e-9));
  const int last_tick = std::max(1, static_cast<int>(std::ceil(highest / step - 1e-9)));
  const double scale = kPlot / (step * (last_tick - first_tick));
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  const double left = CalcLabelWidth(labels) + kGap;
  const double bottom = kRow * static_cast<double>(plot.rows.size());

  const auto place_x = [&](double value) { return left + scale * (value - step * first_tick); };

  Html content;
  for (int tick = first_tick; tick <= last_tick; ++tick) {
    const double x = place_x(step * tick);
    content += Line(tick == 0 ? "grid zero" : "grid", x, 0.0, x, bottom);
    content += Label("middle small", x, bottom + 11.0, FormatFixed(step * tick, decimals));
  }
  content += Label("middle small", left + kPlot / 2.0, bottom + 28.0, plot.axis);
  for (size_t r = 0; r < plot.rows.size(); ++r) {
    const DotStrips::Row& row = plot.rows[r];
    const double middle = kRow * (static_cast<double>(r) + 0.5);
    content += Label("end", left - kGap, middle, row.label);
    if (r > 0) content += Line("grid", left, kRow * r, left + kPlot, kRow * r);
    std::vector<double> values;
    int num_missing = 0;
    for (size_t i = 0; i < row.dots.size(); ++i) {
      const DotStrips::Dot& dot = row.dots[i];
      if (!std::isfinite(dot.value)) {
        ++num_missing;
        continue;
      }
      values.push_back(dot.value);
      const double x = place_x(dot.value);
      const double place = (static_cast<double>(i) + 0.5) / static_cast<double>(row.dots.size());
      const double y = middle + kSpread * (place - 0.5);
      content +=
          dot.is_filled
              ? Element("circle", {{"class", "dot"}, {"cx", Px(x)}, {"cy", Px(y)}, {"r", Px(kDot)}},
                        Hint(dot.hint))
              : Element(
                    "path",
                    {{"class", "cross"},
                     {"d", "M" + Px(x - kDot) + " " + Px(y - kDot) + "l6.4 6.4m0 -6.4l-6.4 6.4"}},
                    Hint(dot.hint));
    }
    const Spread spread = CalcSpread(values);
    if (spread.n > 0) {
      const double x = place_x(spread.median);
      content += Line("median", x, middle - kRow / 2.0 + 3.0, x, middle + kRow / 2.0 - 3.0);
    }
    if (num_missing > 0) {
      content += Label("start small", left + kPlot + kGap, middle,
                       std::to_string(num_missing) + " " + plot.missing);
    }
  }
  const double width = left + kPlot + 2.0 * kGap + kLetterWidth * (3.0 + plot.missing.size());
  return Svg("img", width, bottom + kAxis, plot.text, content);
}

}  // namespace graspbench
