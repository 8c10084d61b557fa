#include <algorithm>

#include "core/base/text/csv.h"
#include "datasets/analysis/conditions/sweep_summary.h"

namespace graspbench {
namespace {

std::vector<CsvColumn<ConditionRow>> ListConditionColumns(const SweepSummary& summary) {
  using Row = ConditionRow;
  std::vector<CsvColumn<Row>> columns = {
      {"condition", "", "name of the condition; empty: the base", &Row::name}};
  for (size_t i = 0; i < summary.factors.size(); ++i) {
    std::string name = summary.factors[i].key;
    std::replace(name.begin(), name.end(), '.', '_');
    columns.push_back({name, "", "level of the factor " + summary.factors[i].key,
                       [i](const Row& row) { return row.levels[i]; }});
  }
  const auto add = [&](const char* name, const char* meaning, int Row::*member) {
    columns.push_back({name, "", meaning, [member](const Row& row) { return row.*member; }});
  };
  columns.push_back({"hand", "", "id of the hand", &Row::hand});
  add("planned", "trials of the plan", &Row::num_planned);
  add("finished", "finished trials", &Row::num_finished);
  add("successes", "of these", &Row::num_successes);
  add("numerical_failures", "of the finished trials", &Row::num_numerical);
  for (size_t i = 1; i < ListSweepMeasures().size(); ++i) {
    const std::string id = ListSweepMeasures()[i].id;
    columns.push_back({"median_" + id, "",
                       ListSweepMeasures()[i].threshold
                           ? "over the draws; empty: not looked for, or half never held"
                           : "over the trials that have it",
                       [i](const Row& row) { return row.medians[i]; }});
  }
  columns.push_back({"undecided", "",
                     "why these trials cannot decide success; empty: some succeed, some fail",
                     &Row::undecided});
  return columns;
}

std::vector<CsvColumn<SweepEffect>> ListEffectColumns() {
  using Row = SweepEffect;
  const auto take = [](std::vector<std::string> Row::*list, size_t place) {
    return [list, place](const Row& row) {
      return (row.*list).size() > place ? Json((row.*list)[place]) : Json();
    };
  };
  return {
      {"factor", "string", "", "key of the factor", take(&Row::factors, 0)},
      {"level", "string", "", "its level, against that of the base", take(&Row::levels, 0)},
      {"with_factor", "string", "", "of an interaction the second factor", take(&Row::factors, 1)},
      {"with_level", "string", "", "and its level", take(&Row::levels, 1)},
      {"hand", "", "id of the hand", &Row::hand},
      {"measure", "",
       "success (0 or 1), gft_ratio, sigma_n, breaking_force_n; threshold_margin and "
       "threshold_force_n as binary logarithms: a change of 1 is twice the grip",
       &Row::measure},
      {"draws", "", "that have every value", &Row::num_draws},
      {"objects", "", "of these draws", &Row::num_objects},
      {"marginal", "",
       "1 when no two conditions differ in the factor alone, so that means over all conditions "
       "are compared",
       &Row::is_marginal},
      {"change", "", "mean over draws, in the measure's unit", &Row::estimate},
      {"low", "", "95 % interval from drawing objects",
       [](const Row& row) { return row.interval ? row.interval->low : kUnset; }},
      {"high", "", "likewise",
       [](const Row& row) { return row.interval ? row.interval->high : kUnset; }},
      {"no_interval", "", "why there is none",
       [](const Row& row) { return row.interval ? "" : row.interval.reason(); }},
      {"left_out", "", "planned draws that the change leaves out", &Row::num_left_out},
      {"why_left_out", "", "how many of them for which reason", &Row::why_left_out}};
}

}  // namespace

std::vector<ExportTable> MakeSweepTables(const SweepSummary& summary) {
  const auto conditions = ListConditionColumns(summary);
  const auto effects = ListEffectColumns();
  std::vector<SweepEffect> all = summary.effects;
  all.insert(all.end(), summary.interactions.begin(), summary.interactions.end());
  return {{"conditions", FormatCsv(conditions, summary.rows), MakeTableSchema(conditions, "")},
          {"effects", FormatCsv(effects, all), MakeTableSchema(effects, "")}};
}

Json ToJson(const SweepSummary& summary) {
  const auto list = [](const auto& columns, const auto& rows) {
    Json json = Json::array();
    for (const auto& row : rows) {
      Json object = Json::object();
      for (const auto& column : columns) object[column.name] = column.value(row);
      json.push_back(object);
    }
    return json;
  };
  Json factors = Json::array();
  for (const SweepFactor& factor : summary.factors) {
    factors.push_back({{"key", factor.key}, {"levels", factor.levels}});
  }
  Json thresholds = Json::array();
  for (const ConditionThresholds& row : summary.thresholds) {
    thresholds.push_back({{"scale", row.scale->name},
                          {"condition", row.name},
                          {"hand", row.hand},
                          {"draws", row.num_draws},
                          {"held_by_least", row.num_below},
                          {"never_held", row.num_never},
                          {"not_monotone", row.not_monotone}});
  }
  return {{"factors", factors},
          {"thresholds", thresholds},
          {"conditions", list(ListConditionColumns(summary), summary.rows)},
          {"effects", list(ListEffectColumns(), summary.effects)},
          {"interactions", list(ListEffectColumns(), summary.interactions)}};
}

}  // namespace graspbench
