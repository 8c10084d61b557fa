#include "workbench/tables/sweep_tables.h"

#include <algorithm>

#include "core/base/text/text.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

std::string FormatConditions(const SweepSummary& summary) {
  std::vector<std::string> heading = {"condition", "hand", "trials"};
  for (size_t i = 0; i < ListSweepMeasures().size(); ++i) {
    if (summary.Shows(i)) heading.push_back(ListSweepMeasures()[i].label);
  }
  TextTable table(heading);
  bool is_undecided = false;
  for (const ConditionRow& row : summary.rows) {
    std::vector<std::string> cells = {row.name.empty() ? "base" : row.name, row.hand,
                                      std::to_string(row.num_finished)};
    for (size_t i = 0; i < row.medians.size(); ++i) {
      if (summary.Shows(i)) cells.push_back(FormatValue(ListSweepMeasures()[i], row.medians[i]));
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
  std::vector<std::string> heading = {"level", "hand",   "measure",
                                      "draws", "change", "95 % interval"};
  const bool leaves_out =
      std::any_of(effects.begin(), effects.end(),
                  [](const SweepEffect& effect) { return effect.num_left_out > 0; });
  if (leaves_out) heading.push_back("left out");
  TextTable table(heading);
  for (const SweepEffect& effect : effects) {
    const SweepMeasure& measure = FindSweepMeasure(effect.measure);
    std::vector<std::string> cells = {NameEffect(effect),
                                      effect.hand,
                                      measure.label,
                                      CountDraws(effect),
                                      FormatChange(measure, effect.estimate),
                                      effect.interval
                                          ? FormatChangeInterval(measure, *effect.interval)
                                          : effect.interval.reason()};
    if (leaves_out) cells.push_back(effect.why_left_out);
    table.AddRow(cells);
  }
  return table.Format();
}

std::string FormatThresholds(const std::vector<ConditionThresholds>& rows) {
  if (rows.empty()) return "";
  TextTable table({"condition", "hand", "grip threshold", "draws", "held by the least",
                   "never held", "not monotone"});
  for (const ConditionThresholds& row : rows) {
    table.AddRow({row.name.empty() ? "base" : row.name, row.hand, row.scale->name,
                  std::to_string(row.num_draws), std::to_string(row.num_below),
                  std::to_string(row.num_never), row.not_monotone});
  }
  return "\n" + table.Format() + "not monotone: trials that fail again with a larger grip\n";
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
  return text + FormatThresholds(summary.thresholds);
}

}  // namespace graspbench
