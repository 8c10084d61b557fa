#include "reports/plots/svg_parts.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text/text.h"

namespace graspbench {
namespace {

// Approximate width of a letter in the 13 px labels.
constexpr double kLetterWidth = 7.4;
constexpr double kMaxLabelWidth = 320.0;

}  // namespace

std::string Px(double value) { return FormatFixed(value, 1); }

Html Hint(const std::string& text) { return text.empty() ? Html() : Element("title", {}, text); }

Html Rect(const std::string& css_class, double x, double y, double width, double height,
          const std::string& hint) {
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

Html DrawCursor(double from, double to, double left, double width, double top, double bottom) {
  return Element("line", {{"class", "cursor"},
                          {"x1", Px(left)},
                          {"y1", Px(top)},
                          {"x2", Px(left)},
                          {"y2", Px(bottom)},
                          {"data-left", Px(left)},
                          {"data-width", Px(width)},
                          {"data-from", FormatFixed(from, 6)},
                          {"data-to", FormatFixed(to, 6)}});
}

Html Label(const std::string& css_class, double x, double y, const std::string& text) {
  return Element("text", {{"class", css_class}, {"x", Px(x)}, {"y", Px(y)}}, text);
}

Html MaybeLink(const std::string& anchor, const Html& content) {
  if (anchor.empty()) return content;
  const bool is_elsewhere = anchor.find('#') != anchor.npos;
  return Element("a", {{"href", is_elsewhere ? anchor : "#" + anchor}}, content);
}

double CalcLabelWidth(const std::vector<std::string>& labels) {
  size_t longest = 0;
  for (const std::string& label : labels) longest = std::max(longest, label.size());
  return std::min(kMaxLabelWidth, kLetterWidth * static_cast<double>(longest) + kPlotGap);
}

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

Axis::Axis(double lowest, double highest, int count) {
  if (!std::isfinite(lowest) || !std::isfinite(highest)) lowest = highest = 0.0;
  const double step = CalcTickStep(highest > lowest ? highest - lowest : 1.0, count);
  const double first = std::floor(lowest / step + 1e-9);
  const double last = std::max(first + 1.0, std::ceil(highest / step - 1e-9));
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  for (double tick = first; tick <= last; tick += 1.0) {
    ticks_.push_back({step * tick, FormatFixed(step * tick, decimals)});
  }
  low_ = step * first;
  high_ = step * last;
}

double CalcTickStep(double range, int count) {
  GRASPBENCH_DEMAND(range > 0.0 && count > 0, std::to_string(range));
  const double power = std::pow(10.0, std::floor(std::log10(range / count)));
  for (double factor : {1.0, 2.0, 5.0}) {
    if (range / (factor * power) <= count) return factor * power;
  }
  return 10.0 * power;
}

}  // namespace graspbench
