#pragma once
/** @file
A value of each person under several conditions, one line per person: who follows the mean, who does
not. Inline SVG by the same rules as svg_plot.h. */

#include <string>
#include <vector>

#include "core/base/units.h"
#include "reports/page/html.h"
#include "reports/plots/svg_parts.h"

namespace graspbench {

struct PairedPlot {
  struct Person {
    std::string name;
    std::vector<double> values;  ///< one per condition; NaN: none, the line is interrupted
  };
  PlotText text;
  std::string axis;                     ///< of the values, with unit
  std::vector<std::string> conditions;  ///< in their order
  std::vector<Person> persons;
  std::vector<double> means;  ///< over persons, one per condition; NaN: none
};
Html DrawPairedPlot(const PairedPlot& plot);

}  // namespace graspbench
