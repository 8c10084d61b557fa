#include <algorithm>

#include "core/base/text/csv.h"
#include "core/base/text/text.h"
#include "datasets/analysis/conditions/sweep_summary.h"

namespace graspbench {
namespace {

std::string NameBase(const std::string& condition) {
  return condition.empty() ? "base" : condition;
}

std::vector<CsvColumn<ConditionRow>> ListConditionColumns(const SweepSummary& summary) {
  using Row = ConditionRow;
  using C = CsvColumn<Row>;
  std::vector<C> columns = {
      C("condition", "", "name of the condition; empty: the base", &Row::name)
          .Shown("condition", [](const Row& row) { return NameBase(row.name); })};
  for (size_t i = 0; i < summary.factors.size(); ++i) {
    std::string name = summary.factors[i].key;
    std::replace(name.begin(), name.end(), '.', '_');
    columns.push_back({name, "", "level of the factor " + summary.factors[i].key,
                       [i](const Row& row) { return row.levels[i]; }});
  }
  columns.push_back(C("hand", "", "id of the hand", &Row::hand).Shown("hand"));
  columns.push_back({"planned", "", "trials of the plan", &Row::num_planned});
  columns.push_back(
      C("finished", "", "finished trials", &Row::num_finished).Shown("trials", [](const Row& row) {
        return FormatCountOf(row.num_finished, row.num_planned);
      }));
  columns.push_back({"successes", "", "of these", &Row::num_successes});
  columns.push_back({"numerical_failures", "", "of the finished trials", &Row::num_numerical});
  for (size_t i = 0; i < ListSweepMeasures().size(); ++i) {
    const SweepMeasure& measure = ListSweepMeasures()[i];
    C column("median_" + std::string(measure.id), "",
             measure.threshold ? "over the draws; empty: not looked for, or half never held"
                               : "over the trials that have it",
             [i](const Row& row) { return row.medians[i]; });
    if (i == 0) column = C::ForPeople("", "rate", {});
    if (summary.Shows(i)) {
      column = column.Shown(measure.label, [i, &measure](const Row& row) {
        return FormatValue(measure, row.medians[i]);
      });
    }
    columns.push_back(column);
  }
  columns.push_back(
      C("other_grasps", "", "objects whose grasp differs from that of the base", &Row::other_grasps)
          .Shown("grasp changed"));
  columns.push_back(C("undecided", "",
                      "why these trials cannot decide success; empty: some succeed, some fail",
                      &Row::undecided)
                        .Shown("note"));
  return columns;
}

std::string FormatEffectInterval(const SweepEffect& effect) {
  const SweepMeasure& measure = FindSweepMeasure(effect.measure);
  const Answer<Interval>& interval = effect.change.interval;
  if (!interval) return interval.reason();
  return FormatChangeInterval(measure, *interval) +
         (effect.change.is_of_these_objects ? " (these objects)" : "") +
         (!effect.excludes_zero() ? ""
          : measure.threshold     ? ", excludes 1"
                                  : ", excludes 0");
}

std::vector<CsvColumn<SweepEffect>> ListEffectColumns() {
  using Row = SweepEffect;
  using C = CsvColumn<Row>;
  const auto take = [](std::vector<std::string> Row::*list, size_t place) {
    return [list, place](const Row& row) {
      return (row.*list).size() > place ? Json((row.*list)[place]) : Json();
    };
  };
  return {{"factor", "string", "", "key of the factor", take(&Row::factors, 0)},
          {"level", "string", "", "level, compared with the base level", take(&Row::levels, 0)},
          {"with_factor", "string", "", "second factor of an interaction", take(&Row::factors, 1)},
          {"with_level", "string", "", "and its level", take(&Row::levels, 1)},
          C::ForPeople("level", "", NameEffect),
          C("hand", "", "id of the hand", &Row::hand).Shown("hand"),
          C("measure", "",
            "success (0 or 1), gft_ratio, sigma_n, breaking_force_n; threshold_margin and "
            "threshold_force_n as binary logarithms: a change of 1 is twice the grip",
            &Row::measure)
              .Shown("measure", [](const Row& row) { return FindSweepMeasure(row.measure).label; }),
          C("draws", "", "draws (and objects) with all values",
            [](const Row& row) { return row.change.num_draws; })
              .Shown("draws",
                     [](const Row& row) {
                       const int num = row.change.num_draws;
                       return FormatCountOf(num, num + row.num_left_out) +
                              (row.num_other_grasp == 0
                                   ? ""
                                   : ", " + std::to_string(row.num_other_grasp) +
                                         " with another grasp");
                     }),
          C("objects", "", "of these draws",
            [](const Row& row) {
              return row.change.num_objects;
            }).Shown("objects"),
          {"marginal", "",
           "1 if no two conditions differ in this factor only; means over all conditions are then "
           "compared",
           &Row::is_marginal},
          C("change", "", "mean over draws, in the measure's unit",
            [](const Row& row) { return row.change.estimate; })
              .Shown("change",
                     [](const Row& row) {
                       return FormatChange(FindSweepMeasure(row.measure), row.change.estimate);
                     }),
          C("low", "", "95 % interval from resampling objects",
            [](const Row& row) {
              return row.change.interval ? row.change.interval->low : kUnset;
            }).Shown("95 % interval", FormatEffectInterval),
          {"high", "", "upper end of the 95 % interval",
           [](const Row& row) { return row.change.interval ? row.change.interval->high : kUnset; }},
          {"no_interval", "", "reason for a missing interval",
           [](const Row& row) {
             return row.change.interval ? std::string() : row.change.interval.reason();
           }},
          {"left_out", "", "planned draws that the change leaves out", &Row::num_left_out},
          C("why_left_out", "", "their number by reason", &Row::why_left_out).Shown("left out"),
          {"other_grasp", "", "draws whose compared trials have different grasps",
           &Row::num_other_grasp},
          {"of_these_objects", "",
           "1 if the interval resamples the pairs and holds for these objects only",
           [](const Row& row) { return row.change.is_of_these_objects; }}};
}

std::vector<CsvColumn<ConditionThresholds>> ListThresholdColumns() {
  using Row = ConditionThresholds;
  using C = CsvColumn<Row>;
  return {
      C("scale", "", "", [](const Row& row) { return row.scale->name; }).Shown("grip threshold"),
      C("condition", "", "", &Row::name)
          .Shown("condition", [](const Row& row) { return NameBase(row.name); }),
      C("hand", "", "", &Row::hand).Shown("hand"),
      C("draws", "", "", &Row::num_draws).Shown("draws"),
      C("held_by_least", "", "draws whose threshold is at or below the end of the scale",
        &Row::num_below)
          .Shown("held by the least"),
      C("never_held", "", "draws that no tested grip holds", &Row::num_never).Shown("never held"),
      C("not_monotone", "", "draws that fail again with a larger grip", &Row::not_monotone)
          .Shown("not monotone")};
}

}  // namespace

ShownTable ShowConditions(const SweepSummary& summary) {
  return ShowTable(ListConditionColumns(summary), summary.rows);
}

ShownTable ShowEffects(const std::vector<SweepEffect>& effects) {
  return ShowTable(ListEffectColumns(), effects);
}

ShownTable ShowThresholds(const SweepSummary& summary) {
  return ShowTable(ListThresholdColumns(), summary.thresholds);
}

std::vector<ExportTable> MakeSweepTables(const SweepSummary& summary) {
  const auto conditions = ListConditionColumns(summary);
  const auto effects = ListEffectColumns();
  std::vector<SweepEffect> all = summary.effects;
  all.insert(all.end(), summary.interactions.begin(), summary.interactions.end());
  return {{"conditions", FormatCsv(conditions, summary.rows), MakeTableSchema(conditions, "")},
          {"effects", FormatCsv(effects, all), MakeTableSchema(effects, "")}};
}

Json ToJson(const SweepSummary& summary) {
  Json factors = Json::array();
  for (const SweepFactor& factor : summary.factors) {
    factors.push_back({{"key", factor.key}, {"levels", factor.levels}});
  }
  return {{"factors", factors},
          {"thresholds", MakeJsonRows(ListThresholdColumns(), summary.thresholds)},
          {"conditions", MakeJsonRows(ListConditionColumns(summary), summary.rows)},
          {"effects", MakeJsonRows(ListEffectColumns(), summary.effects)},
          {"interactions", MakeJsonRows(ListEffectColumns(), summary.interactions)}};
}

}  // namespace graspbench
