#pragma once
/** @file
What every plot is drawn from, in CSS pixels: boxes, lines, labels, axes with round ticks, and the
frame that carries the plot's title and description. */

#include <string>
#include <vector>

#include "reports/page/html.h"

namespace graspbench {

struct PlotText {
  std::string title;
  std::string description;  ///< what a person would say who reads the plot aloud
};

/** Distance between parts of a plot [px]. */
inline constexpr double kPlotGap = 8.0;

/** A length in pixels with one decimal. */
std::string Px(double value);

/** Shown when its parent is pointed at; nothing for an empty text. */
Html Hint(const std::string& text);

Html Rect(const std::string& css_class, double x, double y, double width, double height,
          const std::string& hint = {});

Html Line(const std::string& css_class, double x1, double y1, double x2, double y2);

/** A vertical line that a script moves to a value between `from` and `to`, which stand at left and
left + width; not seen without it. */
Html DrawCursor(double from, double to, double left, double width, double top, double bottom);

/** Text centred about y in height; css_class says where x is: "start", "middle" or "end". */
Html Label(const std::string& css_class, double x, double y, const std::string& text);

/** The content as a link to an anchor of the page; as it is without one. */
Html MaybeLink(const std::string& anchor, const Html& content);

/** Room for the widest of the labels [px]. */
double CalcLabelWidth(const std::vector<std::string>& labels);

/** The whole plot. @param role  "img"; "group" for a plot with links, because the links of an "img"
are hidden from screen readers. */
Html Svg(const char* role, double width, double height, const PlotText& text, const Html& content);

/** A linear axis whose ends are round ticks at or outside the range of the values. */
class Axis {
 public:
  struct Tick {
    double value = 0.0;
    std::string text;
  };

  /** @param count  about as many intervals between ticks. Equal or missing ends give a range of 1.
   */
  Axis(double lowest, double highest, int count);

  /** 0 at the lower end, 1 at the upper end. */
  double CalcShare(double value) const { return (value - low_) / (high_ - low_); }
  const std::vector<Tick>& ticks() const { return ticks_; }

 private:
  double low_ = 0.0, high_ = 1.0;
  std::vector<Tick> ticks_;
};

/** Distance of round ticks, 1, 2 or 5 times a power of ten, so that about `count` fit into `range`.
@pre range > 0, count > 0 */
double CalcTickStep(double range, int count);

}  // namespace graspbench
