#include <algorithm>

#include "core/base/text/range_text.h"
#include "core/base/text/text.h"
#include "workbench/tables/experiment_tables.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

constexpr double kLevel = 0.05;  // of all relations together, after Holm

std::string FormatRelation(const SimultaneityRelation& row) {
  if (!row.relation) return "n/a";
  const WithinCorrelation& relation = *row.relation;
  const Interval range = relation.interval ? *relation.interval : Interval{kUnset, kUnset};
  return FormatWithRange(relation.correlation, range.low, range.high, 2) +
         (row.p_holm <= kLevel ? " *" : "");
}

std::string FormatMeans(const DoseResponse& row) {
  std::string text;
  for (const double mean : row.means) {
    text += (text.empty() ? "" : " ") +
            FormatFixed(row.response.scale * mean, std::min(row.response.decimals, 2));
  }
  return text;
}

}  // namespace

std::string FormatRelations(const std::vector<SimultaneityRelation>& relations) {
  const bool is_any = std::any_of(relations.begin(), relations.end(),
                                  [](const auto& row) { return row.relation.has_value(); });
  if (!is_any) {
    return "no relation can be found: no condition (hand, object, grasp) has three trials or more "
           "that "
           "differ in what is compared; run more trials of each\n";
  }
  TextTable table({"hand", "of the trial", "measure", "trials", "conditions", "rank correlation"});
  for (const SimultaneityRelation& row : relations) {
    const bool has_numbers = row.relation.has_value();
    table.AddRow({row.hand, row.response->shown.label, NameTimingMeasure(row.measure),
                  has_numbers ? std::to_string(row.relation->num_pairs) : "0",
                  has_numbers ? std::to_string(row.relation->num_groups) : "0",
                  FormatRelation(row)});
  }
  return table.Format() +
         "within conditions (hand, object, grasp), with 95 % intervals; * differs from 0 at 5 % "
         "over all rows (Holm)\n";
}

std::string FormatDoseResponses(const std::vector<DoseResponse>& rows) {
  std::string delays;
  for (const double delay : ListDelays()) {
    delays += (delays.empty() ? "" : ", ") + FormatFixed(1e3 * delay, 0);
  }
  TextTable table({"object", "late digit", "hand", "of the trial", "trials",
                   "means at " + delays + " ms", "change for 100 ms"});
  bool leaves_out = false;
  for (const DoseResponse& row : rows) {
    leaves_out = leaves_out || row.num_left_out > 0;
    const Interval range = row.interval ? *row.interval : Interval{kUnset, kUnset};
    const double scale = row.response.scale;
    table.AddRow({row.condition, row.digit, row.hand, row.response.label,
                  FormatCountOf(row.num_trials, row.num_trials + row.num_left_out),
                  FormatMeans(row),
                  FormatWithRange(scale * row.change, scale * range.low, scale * range.high,
                                  std::max(row.response.decimals, 1))});
  }
  return table.Format() +
         (leaves_out ? "n of N trials: the others have no value at some delay\n" : "") +
         "the same trials on the same draws with one digit late; 95 % intervals from drawing "
         "conditions; all but success, pushes and turns are of trials that succeed at every "
         "delay\n";
}

}  // namespace graspbench
