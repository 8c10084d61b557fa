#include "reports/plots/paired_plot.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace graspbench {

Html DrawPairedPlot(const PairedPlot& plot) {
  constexpr double kColumn = 80.0, kTop = 26.0, kHeight = 220.0, kFoot = 26.0, kDot = 2.5;
  double lowest = INFINITY, highest = -INFINITY;
  for (const PairedPlot::Person& person : plot.persons) {
    GRASPBENCH_DEMAND(person.values.size() == plot.conditions.size(), person.name);
    for (const double value : person.values) {
      if (!std::isfinite(value)) continue;
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
  }
  const Axis axis(lowest, highest, 5);
  std::vector<std::string> ticks;
  for (const Axis::Tick& tick : axis.ticks()) ticks.push_back(tick.text);
  const double left = CalcLabelWidth(ticks) + kPlotGap;
  const double column = std::max(kColumn, CalcLabelWidth(plot.conditions) + kPlotGap);
  const double width = column * static_cast<double>(plot.conditions.size());
  const auto place_x = [&](size_t k) { return left + column * (static_cast<double>(k) + 0.5); };
  const auto place_y = [&](double v) { return kTop + kHeight * (1.0 - axis.CalcShare(v)); };

  Html content = Label("start small", 0.0, kTop / 2.0 - 2.0, plot.axis);
  for (const Axis::Tick& tick : axis.ticks()) {
    const double y = place_y(tick.value);
    content += Line(tick.value == 0.0 ? "grid zero" : "grid", left, y, left + width, y);
    content += Label("end small", left - kPlotGap, y, tick.text);
  }
  for (size_t k = 0; k < plot.conditions.size(); ++k) {
    content += Label("middle small", place_x(k), kTop + kHeight + kFoot / 2.0, plot.conditions[k]);
  }
  for (const PairedPlot::Person& person : plot.persons) {
    Html lines = Hint(person.name);
    for (size_t k = 0; k < person.values.size(); ++k) {
      if (!std::isfinite(person.values[k])) continue;
      const double x = place_x(k), y = place_y(person.values[k]);
      lines +=
          Element("circle", {{"class", "single"}, {"cx", Px(x)}, {"cy", Px(y)}, {"r", Px(kDot)}});
      if (k == 0 || !std::isfinite(person.values[k - 1])) continue;
      lines += Line("single", place_x(k - 1), place_y(person.values[k - 1]), x, y);
    }
    content += Element("g", {}, lines);
  }
  for (size_t k = 0; k < plot.means.size(); ++k) {
    if (!std::isfinite(plot.means[k])) continue;
    const double y = place_y(plot.means[k]);
    content += Line("interval", place_x(k) - 12.0, y, place_x(k) + 12.0, y);
    if (k == 0 || !std::isfinite(plot.means[k - 1])) continue;
    content += Line("interval", place_x(k - 1), place_y(plot.means[k - 1]), place_x(k), y);
  }
  return Svg("img", left + width, kTop + kHeight + kFoot, plot.text, content);
}

}  // namespace graspbench
