#include "workbench/tables/sweep_tables.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/range_text.h"
#include "core/base/text/text.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

std::string FormatConditions(const SweepSummary& summary) {
  std::vector<std::string> heading = {"condition", "hand", "trials"};
  for (const SweepMeasure& measure : ListSweepMeasures()) heading.push_back(measure.label);
  TextTable table(heading);
  bool is_undecided = false;
  for (const ConditionRow& row : summary.rows) {
    std::vector<std::string> cells = {row.name.empty() ? "base" : row.name, row.hand,
                                      std::to_string(row.num_finished)};
    for (size_t i = 0; i < row.medians.size(); ++i) {
      const SweepMeasure& measure = ListSweepMeasures()[i];
      cells.push_back(std::isfinite(row.medians[i])
                          ? FormatFixed(measure.scale * row.medians[i], measure.decimals)
                          : "n/a");
    }
    if (!row.undecided.empty()) cells[3] += " *";
    is_undecided = is_undecided || !row.undecided.empty();
    table.AddRow(cells);
  }
  return table.Format() + "rate of success, medians of the rest\n" +
         (is_undecided ? "* cannot decide success: all trials of the condition succeed, or none\n"
                       : "");
}

std::string FormatEffects(const std::vector<SweepEffect>& effects) {
  TextTable table({"level", "hand", "measure", "draws", "change", "95 % interval"});
  for (const SweepEffect& effect : effects) {
    const auto& measures = ListSweepMeasures();
    const auto measure =
        std::find_if(measures.begin(), measures.end(),
                     [&](const SweepMeasure& one) { return one.id == effect.measure; });
    table.AddRow({NameEffect(effect), effect.hand, measure->label, std::to_string(effect.num_draws),
                  FormatFixed(measure->scale * effect.estimate, measure->decimals),
                  effect.interval
                      ? FormatRange(measure->scale * effect.interval->low,
                                    measure->scale * effect.interval->high, measure->decimals)
                      : effect.interval.reason()});
  }
  return table.Format();
}

}  // namespace

std::string FormatSweepTables(const SweepSummary& summary) {
  std::vector<SweepEffect> named;
  std::copy_if(summary.interactions.begin(), summary.interactions.end(), std::back_inserter(named),
               [](const SweepEffect& effect) { return effect.excludes_zero(); });
  std::string text = FormatConditions(summary) + "\n" + FormatEffects(summary.effects) +
                     "against the base's level, on the same draws; intervals from drawing "
                     "objects\n";
  if (!named.empty()) {
    text += "\ninteractions whose interval excludes 0\n" + FormatEffects(named);
  } else if (!summary.interactions.empty()) {
    text += "no interval of an interaction excludes 0\n";
  }
  return text;
}

}  // namespace graspbench
