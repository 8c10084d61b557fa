#include "workbench/tables/threshold_tables.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/range_text.h"
#include "core/base/text/text.h"
#include "workbench/tables/text_table.h"

namespace graspbench {

std::string FormatThresholdTables(const ThresholdSummary& summary) {
  const ThresholdScale& scale = *summary.scale;
  const bool is_sweep =
      std::any_of(summary.cells.begin(), summary.cells.end(),
                  [](const CellThreshold& cell) { return !cell.condition.empty(); });
  std::vector<std::string> heading = {"hand",       "object",         "grasp",
                                      "draws",      "grip threshold", "95 % interval",
                                      "never held", "not monotone"};
  if (is_sweep) heading.insert(heading.begin(), "condition");
  TextTable table(heading);
  int num_draws = 0;
  for (const CellThreshold& cell : summary.cells) {
    num_draws += cell.num_draws;
    std::vector<std::string> cells = {
        cell.hand,
        cell.object,
        cell.grasp,
        std::to_string(cell.num_draws),
        FormatMedian(scale, cell),
        std::isnan(cell.low)
            ? "n/a"
            : FormatThreshold(scale, cell.low) + " to " + FormatThreshold(scale, cell.high),
        std::to_string(cell.num_never),
        NameNotMonotone(cell)};
    if (is_sweep) cells.insert(cells.begin(), cell.condition.empty() ? "base" : cell.condition);
    table.AddRow(cells);
  }
  const std::string ceilings = DescribeCeilings(summary);
  return table.Format() + "smallest " + scale.name +
         " with which a draw succeeds, median of the draws; " + FormatCount(num_draws, "draw") +
         ", " + FormatCount(summary.num_trials, "trial") + ", " +
         std::to_string(summary.num_not_monotone()) + " not monotone as far as was asked\n" +
         (ceilings.empty() ? "" : ceilings + "\n");
}

std::string FormatThresholdChanges(const std::vector<ThresholdChange>& changes) {
  if (changes.empty()) return "";
  TextTable table(
      {"grip threshold", "hand", "pairs", "second over first", "lower", "equal", "higher"});
  for (const ThresholdChange& change : changes) {
    table.AddRow({change.scale->name, change.hand, std::to_string(change.num_pairs),
                  FormatWithRange(change.ratio, change.low, change.high, 2),
                  std::to_string(change.num_lower), std::to_string(change.num_equal),
                  std::to_string(change.num_higher)});
  }
  return "\n" + table.Format() + "median ratio of the draws' thresholds, with its 95 % interval\n";
}

}  // namespace graspbench
