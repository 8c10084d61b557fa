#include "reports/plots/line_plot.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/base/error.h"
#include "core/base/text/text.h"

namespace graspbench {
namespace {

constexpr size_t kMaxSeries = 8;

/** Smallest and largest of the finite values. */
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void Add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void Add(const std::vector<double>& values) {
    for (double value : values) Add(value);
  }
};

std::string SeriesClass(const char* part, size_t series) {
  return std::string(part) + " series" + std::to_string(series);
}

/** Formats "M x y L x y ..", starting a new subpath after each missing point. */
template <class PlaceX, class PlaceY>
std::string MakePath(const std::vector<double>& x, const std::vector<double>& y,
                     const PlaceX& place_x, const PlaceY& place_y) {
  std::string path;
  bool is_drawing = false;
  for (size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) {
      is_drawing = false;
      continue;
    }
    path += (is_drawing ? "L" : "M") + Px(place_x(x[i])) + " " + Px(place_y(y[i]));
    is_drawing = true;
  }
  return path;
}

/** A horizontal axis from x = left to left + width below y = bottom, with its grid from `top`. */
Html DrawHorizontalAxis(const Axis& axis, double left, double width, double top, double bottom,
                        const std::string& label) {
  Html content;
  for (const Axis::Tick& tick : axis.ticks()) {
    const double x = left + width * axis.CalcShare(tick.value);
    content += Line(tick.value == 0.0 ? "grid zero" : "grid", x, top, x, bottom);
    content += Label("middle small", x, bottom + 11.0, tick.text);
  }
  content += Label("middle small", left + width / 2.0, bottom + 28.0, label);
  return content;
}

using Place = std::function<double(double)>;

/** Draws the band between `low` and `high` of a series where both are finite. */
Html DrawBand(const LinePlot::Series& series, size_t number, const Place& place_x,
              const Place& place_y) {
  std::vector<double> x, edge;
  const auto add = [&](size_t k, const std::vector<double>& values) {
    if (!std::isfinite(series.low[k]) || !std::isfinite(series.high[k])) return;
    x.push_back(series.x[k]);
    edge.push_back(values[k]);
  };
  for (size_t k = 0; k < series.low.size(); ++k) add(k, series.high);
  for (size_t k = series.low.size(); k-- > 0;) add(k, series.low);
  if (x.empty()) return {};
  return Element("path", {{"class", SeriesClass("band", number)},
                          {"d", MakePath(x, edge, place_x, place_y) + "Z"}});
}

Html DrawMarks(const std::vector<StripChart::Mark>& unsorted, double y, double left,
               const Place& place_x) {
  constexpr double kMark = 8.0;
  std::vector<StripChart::Mark> marks = unsorted;
  std::stable_sort(marks.begin(), marks.end(),
                   [](const auto& a, const auto& b) { return a.at < b.at; });
  Html content;
  double free_from = left - kMark;
  for (const StripChart::Mark& mark : marks) {
    const double x = std::max(free_from, place_x(mark.at));
    const auto num_letters = std::count_if(mark.symbol.begin(), mark.symbol.end(), [](char c) {
      return (static_cast<unsigned char>(c) & 0xC0) != 0x80;  // UTF-8
    });
    free_from = x + kMark * static_cast<double>(num_letters);
    content += Element("text", {{"class", "middle small"}, {"x", Px(x)}, {"y", Px(y)}},
                       Text(mark.symbol) + Hint(mark.hint));
  }
  return content;
}

/** Row of each mark's label above the plot, 0 being the lowest, such that no labels overlap. */
std::vector<int> PlaceMarkLabels(const std::vector<LinePlot::Mark>& marks, const Place& place_x) {
  constexpr double kShare = 11.0 / 13.0;  // of the capital letters that CalcLabelWidth assumes
  std::vector<double> free_from;          // left end of the free part of each row [px]
  std::vector<int> rows;
  for (const LinePlot::Mark& mark : marks) {
    const double half = 0.5 * kShare * CalcLabelWidth({mark.label});
    const auto row = std::find_if(free_from.begin(), free_from.end(),
                                  [&](double from) { return from <= place_x(mark.x) - half; });
    rows.push_back(static_cast<int>(row - free_from.begin()));
    if (row == free_from.end()) free_from.push_back(0.0);
    free_from[static_cast<size_t>(rows.back())] = place_x(mark.x) + half;
  }
  return rows;
}

}  // namespace

Html DrawLinePlot(const LinePlot& plot) {
  GRASPBENCH_DEMAND(plot.series.size() <= kMaxSeries, plot.text.title);
  constexpr double kWidth = 460.0, kHeight = 240.0, kAxis = 38.0, kLegendRow = 18.0, kKey = 26.0;
  constexpr double kAxisName = 24.0;  // above the highest tick, whose label it must not touch
  Range range_x, range_y;
  for (const LinePlot::Series& series : plot.series) {
    GRASPBENCH_DEMAND(series.x.size() == series.y.size(), series.label);
    GRASPBENCH_DEMAND(series.low.size() == series.high.size(), series.label);
    GRASPBENCH_DEMAND(series.low.empty() || series.low.size() == series.x.size(), series.label);
    range_x.Add(series.x);
    range_y.Add(series.y);
    range_y.Add(series.low);
    range_y.Add(series.high);
  }
  for (const LinePlot::Mark& mark : plot.marks) range_x.Add(mark.x);
  if (plot.is_y_from_zero) range_y.Add(0.0);
  const Axis axis_x(range_x.low, range_x.high, 6), axis_y(range_y.low, range_y.high, 5);

  std::vector<std::string> tick_texts;
  for (const Axis::Tick& tick : axis_y.ticks()) tick_texts.push_back(tick.text);
  const double left = CalcLabelWidth(tick_texts) + kPlotGap;
  const std::vector<int> mark_rows =
      PlaceMarkLabels(plot.marks, [&](double x) { return kWidth * axis_x.CalcShare(x); });
  const double mark_room =
      plot.marks.empty() ? 0.0
                         : kLegendRow * (1 + *std::max_element(mark_rows.begin(), mark_rows.end()));
  const double top = kAxisName + mark_room, bottom = top + kHeight;
  const auto place_x = [&](double x) { return left + kWidth * axis_x.CalcShare(x); };
  const auto place_y = [&](double y) { return bottom - kHeight * axis_y.CalcShare(y); };

  Html content = Label("start small", 0.0, kLegendRow / 2.0, plot.y_axis);
  content += DrawHorizontalAxis(axis_x, left, kWidth, top, bottom, plot.x_axis);
  for (const Axis::Tick& tick : axis_y.ticks()) {
    const double y = place_y(tick.value);
    content += Line(tick.value == 0.0 ? "grid zero" : "grid", left, y, left + kWidth, y);
    content += Label("end small", left - kPlotGap, y, tick.text);
  }
  for (size_t m = 0; m < plot.marks.size(); ++m) {
    const double x = place_x(plot.marks[m].x);
    const double row_top = top - kLegendRow * mark_rows[m];
    content += Line("mark", x, row_top, x, bottom);
    content += Label("middle small", x, row_top - kLegendRow / 2.0, plot.marks[m].label);
  }
  if (plot.has_cursor) {
    content += DrawCursor(axis_x.ticks().front().value, axis_x.ticks().back().value, left, kWidth,
                          top, bottom);
  }
  std::vector<std::string> labels;
  for (size_t i = 0; i < plot.series.size(); ++i) {
    const LinePlot::Series& series = plot.series[i];
    labels.push_back(series.label);
    content += DrawBand(series, i, place_x, place_y);
    content += Element(
        "path",
        {{"class", SeriesClass("curve", i)}, {"d", MakePath(series.x, series.y, place_x, place_y)}},
        Hint(series.label));
    if (series.label.empty()) continue;
    const double y = top + kLegendRow * (static_cast<double>(i) + 0.5);
    const double key = left + kWidth + 2.0 * kPlotGap;
    content += Line(SeriesClass("curve", i), key, y, key + kKey, y);
    content += Label("start small", key + kKey + kPlotGap, y, series.label);
  }
  const double legend = 3.0 * kPlotGap + kKey + CalcLabelWidth(labels);
  const double legend_bottom = top + kLegendRow * static_cast<double>(plot.series.size());
  return Svg("img", left + kWidth + legend, std::max(bottom + kAxis, legend_bottom), plot.text,
             content);
}

namespace {

/** Draws ticks below the middle of a row as one path, because there may be thousands. */
template <class PlaceX>
Html DrawSingles(const std::vector<double>& singles, double y, const PlaceX& place_x) {
  constexpr double kBelow = 4.0, kTick = 5.0;
  std::string path;
  for (const double value : singles) {
    if (!std::isfinite(value)) continue;
    path += "M" + Px(place_x(value)) + " " + Px(y + kBelow) + "v" + Px(kTick);
  }
  if (path.empty()) return {};
  return Element("path", {{"class", "single"}, {"d", path}});
}

}  // namespace

Html DrawIntervalPlot(const IntervalPlot& plot) {
  constexpr double kRow = 24.0, kLabelRow = 16.0, kAxis = 38.0, kDot = 4.0, kCap = 4.0;
  constexpr double kNarrow = 332.0, kMargin = 28.0;  // a screen of 380 px, half a mark's label
  constexpr double kSmall = 11.0 / 13.0;             // CalcLabelWidth counts wide letters
  const bool is_above = plot.labels_above;
  Range range;
  std::vector<std::string> labels, texts;
  double above_width = std::max(kNarrow, kSmall * CalcLabelWidth({plot.axis}));
  bool has_links = false;
  for (const IntervalPlot::Row& row : plot.rows) {
    labels.push_back(row.label);
    texts.push_back(row.text);
    above_width =
        std::max(above_width, kSmall * (CalcLabelWidth({row.label}) + CalcLabelWidth({row.text})));
    has_links = has_links || !row.anchor.empty();
    if (row.is_heading) continue;
    GRASPBENCH_DEMAND(row.series >= 0 && row.series < static_cast<int>(kMaxSeries), row.label);
    range.Add(row.value);
    range.Add(row.low);
    range.Add(row.high);
    for (const double value : row.singles) range.Add(value);
  }
  for (const LinePlot::Mark& mark : plot.marks) range.Add(mark.x);
  if (plot.holds_zero) range.Add(0.0);
  const Axis axis(range.low, range.high, 5);
  const double left = is_above ? kMargin : CalcLabelWidth(labels) + kPlotGap;
  const double extent = is_above ? kNarrow - 2.0 * kMargin : 340.0;
  const double width =
      is_above ? above_width : left + extent + 2.0 * kPlotGap + CalcLabelWidth(texts);
  const auto place_x = [&](double value) { return left + extent * axis.CalcShare(value); };

  const std::vector<int> mark_rows = PlaceMarkLabels(plot.marks, place_x);
  const double top = plot.marks.empty()
                         ? 0.0
                         : kLabelRow * (1 + *std::max_element(mark_rows.begin(), mark_rows.end()));
  Html content;
  double bottom = top;
  for (const IntervalPlot::Row& row : plot.rows) {
    const char* const style = row.is_heading ? (is_above ? "start head" : "end head")
                              : is_above     ? "start"
                                             : "end";
    const bool has_own_line = is_above && !row.is_heading;
    const double y = bottom + 0.5 * kRow + (has_own_line ? kLabelRow : 0.0);
    const double label_y = bottom + 0.5 * kRow;
    content +=
        MaybeLink(row.anchor, Label(style, is_above ? 0.0 : left - kPlotGap, label_y, row.label));
    content += Label(is_above ? "end small" : "start small",
                     is_above ? width : left + extent + 2.0 * kPlotGap, label_y, row.text);
    bottom = y + 0.5 * kRow;
    if (row.is_heading) continue;
    content += DrawSingles(row.singles, y, place_x);
    if (std::isfinite(row.low) && std::isfinite(row.high)) {
      const double low = place_x(row.low), high = place_x(row.high);
      content += Line("interval", low, y, high, y);
      content += Line("interval", low, y - kCap, low, y + kCap);
      content += Line("interval", high, y - kCap, high, y + kCap);
    }
    if (std::isfinite(row.value)) {
      content +=
          Element("circle", {{"class", SeriesClass("point", static_cast<size_t>(row.series))},
                             {"cx", Px(place_x(row.value))},
                             {"cy", Px(y)},
                             {"r", Px(kDot)}});
    }
  }
  Html frame = DrawHorizontalAxis(axis, left, extent, top, bottom, is_above ? "" : plot.axis);
  if (is_above) frame += Label("start small", 0.0, bottom + 28.0, plot.axis);  // may be as wide
  for (size_t m = 0; m < plot.marks.size(); ++m) {
    const double x = place_x(plot.marks[m].x), mark_top = top - kLabelRow * mark_rows[m];
    frame += Line("mark", x, mark_top, x, bottom);
    frame += Label("middle small", x, mark_top - 0.5 * kLabelRow, plot.marks[m].label);
  }
  return Svg(has_links ? "group" : "img", width, bottom + kAxis, plot.text, frame + content);
}

Html DrawStripChart(const StripChart& chart) {
  constexpr double kRow = 22.0, kSpan = 12.0, kAxis = 38.0, kPlot = 560.0, kHead = 20.0;
  constexpr double kKey = 18.0, kMinSpan = 1.0, kSmall = 11.0 / 13.0;
  GRASPBENCH_DEMAND(chart.kinds.size() <= kMaxSeries, chart.text.title);
  Range range;
  std::vector<std::string> labels;
  for (const StripChart::Phase& phase : chart.phases) {
    range.Add(phase.from);
    range.Add(phase.to);
  }
  for (const StripChart::Row& row : chart.rows) {
    labels.push_back(row.label);
    for (const StripChart::Span& span : row.spans) {
      range.Add(span.from);
      range.Add(span.to);
    }
    for (const StripChart::Mark& mark : row.marks) range.Add(mark.at);
  }
  const Axis axis(range.low, range.high, 10);
  const double left = CalcLabelWidth(labels) + kPlotGap;
  const auto place_x = [&](double time) { return left + kPlot * axis.CalcShare(time); };
  const double kinds = chart.kinds.empty() ? 0.0 : kHead;
  const double legend = kinds + (chart.symbols.empty() ? 0.0 : kHead);
  const double head = chart.phases.empty() ? 0.0 : kHead;
  const double top = legend + head;
  const double bottom = top + kRow * static_cast<double>(chart.rows.size());

  Html content = DrawHorizontalAxis(axis, left, kPlot, top, bottom, chart.axis);
  double key = left;
  for (size_t k = 0; k < chart.kinds.size(); ++k) {
    content += Rect("part part" + std::to_string(k), key, 3.0, kKey, kSpan);
    content += Label("start small", key + kKey + kPlotGap / 2.0, kHead / 2.0 - 1.0, chart.kinds[k]);
    key += kKey + kPlotGap + CalcLabelWidth({chart.kinds[k]});
  }
  double symbol = left;
  for (const auto& [sign, word] : chart.symbols) {
    content += Label("start small", symbol, kinds + kHead / 2.0 - 1.0, sign + " " + word);
    symbol += kPlotGap + kSmall * CalcLabelWidth({sign + " " + word});
  }
  for (const StripChart::Phase& phase : chart.phases) {
    const double from = place_x(phase.from), to = place_x(phase.to);
    content += Line("mark", from, legend, from, bottom);
    // A short phase has no room for its name, which is shown on hover.
    if (to - from >= kSmall * (CalcLabelWidth({phase.label}) - kPlotGap)) {
      content += Label("middle small", (from + to) / 2.0, legend + kHead / 2.0, phase.label);
    } else {
      content += Rect("hover", from, legend, to - from, kHead, phase.label);
    }
  }
  for (size_t r = 0; r < chart.rows.size(); ++r) {
    const StripChart::Row& row = chart.rows[r];
    const double y = top + kRow * (static_cast<double>(r) + 0.5);
    content += Label("end", left - kPlotGap, y, row.label);
    for (const StripChart::Span& span : row.spans) {
      GRASPBENCH_DEMAND(span.kind >= 0 && span.kind < static_cast<int>(kMaxSeries), row.label);
      const double from = place_x(span.from);
      const double width = std::max(kMinSpan, place_x(span.to) - from);
      content += Rect("part part" + std::to_string(span.kind), from, y - kSpan / 2.0, width, kSpan,
                      span.hint);
    }
    content += DrawMarks(row.marks, y, left, place_x);
  }
  const double width = std::max({left + kPlot + 3.0 * kPlotGap, key, symbol});
  return Svg("img", width, bottom + kAxis, chart.text, content);
}

}  // namespace graspbench
