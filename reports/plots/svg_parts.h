#pragma once
/** @file
Primitives of all plots, in CSS pixels: boxes, lines, labels, axes with round ticks, and the frame
with the plot's title and description. */

#include <string>
#include <vector>

#include "reports/page/html.h"

namespace graspbench {

struct PlotText {
  std::string title;
  std::string description;  ///< description for screen readers
};

/** Distance between parts of a plot [px]. */
inline constexpr double kPlotGap = 8.0;

/** Formats a length in pixels with one decimal. */
std::string Px(double value);

/** Text shown when the pointer hovers over the parent element; nothing for an empty text. */
Html Hint(const std::string& text);

Html Rect(const std::string& css_class, double x, double y, double width, double height,
          const std::string& hint = {});

Html Line(const std::string& css_class, double x1, double y1, double x2, double y2);

/** A vertical line that a script moves to a value between `from` (at left) and `to` (at left +
width); invisible without the script. */
Html DrawCursor(double from, double to, double left, double width, double top, double bottom);

/** Text centred vertically about y; css_class sets the anchor at x: "start", "middle" or "end". */
Html Label(const std::string& css_class, double x, double y, const std::string& text);

/** Makes the content a link to an anchor of the page; unchanged if the anchor is empty. */
Html MaybeLink(const std::string& anchor, const Html& content);

/** Width needed for the widest label [px]. */
double CalcLabelWidth(const std::vector<std::string>& labels);

/** Makes the whole plot. @param role  "img"; "group" for a plot with links, because the links of an
"img" are hidden from screen readers. */
Html Svg(const char* role, double width, double height, const PlotText& text, const Html& content);

/** A linear axis whose ends are round ticks at or outside the range of the values. */
class Axis {
 public:
  struct Tick {
    double value = 0.0;
    std::string text;
  };

  /** @param count  approximate number of intervals between ticks. Equal or missing ends give a
  range of 1.
   */
  Axis(double lowest, double highest, int count);

  /** Returns 0 at the lower end and 1 at the upper end. */
  double CalcShare(double value) const { return (value - low_) / (high_ - low_); }
  const std::vector<Tick>& ticks() const { return ticks_; }

 private:
  double low_ = 0.0, high_ = 1.0;
  std::vector<Tick> ticks_;
};

/** Spacing of round ticks: 1, 2 or 5 times a power of ten, so that about `count` fit into `range`.
@pre range > 0, count > 0. */
double CalcTickStep(double range, int count);

}  // namespace graspbench
