#pragma once
/** @file
A value of each person under several conditions, one line per person, to show who follows the mean.
Inline SVG by the same rules as svg_plot.h. */

#include <string>
#include <vector>

#include "core/base/units.h"
#include "reports/page/html.h"
#include "reports/plots/svg_parts.h"

namespace graspbench {

struct PairedPlot {
  struct Person {
    std::string name;
    std::vector<double> values;  ///< one per condition; NaN: missing, the line is interrupted
  };
  PlotText text;
  std::string axis;                     ///< of the values, with unit
  std::vector<std::string> conditions;  ///< in order
  std::vector<Person> persons;
  std::vector<double> means;  ///< over persons, one per condition; NaN: none
};
Html DrawPairedPlot(const PairedPlot& plot);

}  // namespace graspbench
