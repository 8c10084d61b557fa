#include "human_study/study/inference/condition_estimates.h"

#include <cmath>

namespace graspbench {
namespace {

constexpr BarKind kDrawnBars = BarKind::kLoftusMasson;

void ChooseDrawn(const Answer<CellMeans>& cells, ConditionEstimates& estimates) {
  if (!cells) {
    estimates.drawn = cells.none();
    estimates.drawn_kind = "none, " + cells.reason();
    return;
  }
  estimates.drawn = CalcHalfWidths(*cells, kDrawnBars);
  estimates.drawn_kind = NameOf(kDrawnBars);
  if (estimates.drawn) return;
  estimates.drawn_kind = "none, " + estimates.drawn.reason();
  estimates.drawn = CalcHalfWidths(*cells, BarKind::kBetweenPerson);
  if (estimates.drawn) estimates.drawn_kind = NameOf(BarKind::kBetweenPerson);
}

}  // namespace

ConditionEstimates CalcConditionEstimates(const MeasureStatistics& statistics) {
  ConditionEstimates estimates;
  estimates.cells = ListCells(statistics.table.factors);
  for (size_t cell = 0; cell < estimates.cells.size(); ++cell) {
    const Answer<Summary>& trials = statistics.by_cell[cell];
    const auto column = static_cast<Eigen::Index>(cell);
    estimates.means.push_back(statistics.cells ? statistics.cells->means.col(column).mean()
                              : trials         ? trials->mean
                                               : std::nan(""));
    estimates.num_trials.push_back(trials ? trials->count : 0);
  }
  for (const BarKind kind : ListBarKinds()) {
    estimates.half_widths.push_back(statistics.cells
                                        ? CalcHalfWidths(*statistics.cells, kind)
                                        : Answer<Eigen::VectorXd>(statistics.cells.none()));
  }
  ChooseDrawn(statistics.cells, estimates);
  return estimates;
}

}  // namespace graspbench
