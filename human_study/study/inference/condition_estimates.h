#pragma once
/** @file
The mean of each condition of a measure with all kinds of error bars, as figures and tables show
them. */

#include <string>
#include <vector>

#include "core/statistics/proportion.h"
#include "human_study/study/inference/measure_statistics.h"

namespace graspbench {

struct ConditionEstimates {
  std::vector<std::string> cells;  ///< as ListCells() orders them
  std::vector<double> means;       ///< over people of their means, else over trials; NaN: no trial
  std::vector<int> num_trials;     ///< with a value
  std::vector<Answer<Eigen::VectorXd>> half_widths;  ///< of each of ListBarKinds()
  /** Of the figure: Loftus and Masson's, whose lengths let conditions be compared by eye; where
  these cannot be, the ones between persons. */
  Answer<Eigen::VectorXd> drawn;
  std::string drawn_kind;  ///< for the caption: which, or why there are none

  /** Mean -+ half the drawn length. @pre `drawn` has a value. */
  Interval drawn_interval(size_t cell) const {
    const double half = (*drawn)[static_cast<Eigen::Index>(cell)];
    return {means[cell] - half, means[cell] + half};
  }
};
ConditionEstimates CalcConditionEstimates(const MeasureStatistics& statistics);

}  // namespace graspbench
