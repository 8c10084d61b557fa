#include "workbench/tables/experiment_tables.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "workbench/tables/text_table.h"

namespace graspbench {

namespace {

/** "FF 0, TH 12 %" in the order of the median shares; a digit that never touches comes last. */
std::string FormatTouches(const Answer<TouchLags>& lags) {
  if (!lags) return "n/a";
  std::vector<DigitShare> shares = lags->shares;
  std::stable_sort(shares.begin(), shares.end(),
                   [](const auto& a, const auto& b) { return a.median < b.median; });
  std::string text;
  for (const DigitShare& share : shares) {
    text += (text.empty() ? "" : ", ") + share.digit + " " +
            (std::isinf(share.median) ? "never" : FormatFixed(100.0 * share.median, 0));
  }
  return text;
}

std::string FormatMedianGft(const Answer<TouchLags>& lags) {
  if (!lags || std::isinf(lags->gft)) return "n/a";
  return FormatFixed(MsFromS(lags->gft), 0);
}

std::string FormatRatio(const ScheduleRow& row) {
  if (!row.missed.empty()) return "misses its label";
  if (std::isnan(row.ratio)) return "n/a";
  const Interval range = row.interval.value_or(Interval{kUnset, kUnset});
  return FormatWithRange(row.ratio, range.low, range.high, 2);
}

struct PlannedSchedule {
  const PeopleOnObject* of = nullptr;
  const char* name = nullptr;
  int64_t num_trials = 0;
  std::string missing;  ///< why there is none
};
std::vector<PlannedSchedule> ListPlanned(const SchedulePlan& plan) {
  std::vector<PlannedSchedule> rows;
  const std::vector<PlannedTrial>& trials = plan.session->plan;
  for (const PeopleOnObject& of : plan.people.cells) {
    for (const char* name : kSchedules) {
      const auto missing = of.missing.find(name);
      const auto is_planned = [&](const PlannedTrial& trial) {
        return trial.hand == of.hand && trial.object == of.object &&
               trial.grasp == of.grasp + "-" + name;
      };
      rows.push_back({&of, name, std::count_if(trials.begin(), trials.end(), is_planned),
                      missing == of.missing.end() ? "" : missing->second});
    }
  }
  return rows;
}

std::vector<CsvColumn<PlannedSchedule>> ListPlanColumns() {
  using Row = PlannedSchedule;
  using C = CsvColumn<Row>;
  return {C("object", "", "", [](const Row& row) { return row.of->object; }).Shown("object"),
          C("hand", "", "", [](const Row& row) { return row.of->hand; }).Shown("hand"),
          C("grasp", "", "", [](const Row& row) { return row.of->grasp; }).Shown("grasp"),
          C("schedule", "", "", &Row::name).Shown("schedule"),
          C("trials", "", "", &Row::num_trials).Shown("trials"),
          C("missing", "", "", &Row::missing).Shown("why none")};
}

}  // namespace

std::string FormatSchedulePlan(const SchedulePlan& plan) {
  return FormatTable(ShowTable(ListPlanColumns(), ListPlanned(plan))) +
         "plus several trials for the grip threshold of each draw\n";
}

Json ToJson(const SchedulePlan& plan) { return MakeJsonRows(ListPlanColumns(), ListPlanned(plan)); }

std::string FormatSchedules(const ScheduleComparison& comparison) {
  TextTable table({"object", "hand", "grasp", "schedule",
                   "contact after the first [% of closing time]", "GFT [ms]", "held", "threshold",
                   "of natural"});
  std::string reasons;
  for (const ScheduleCell& cell : comparison.cells) {
    const PeopleOnObject& of = cell.of;
    const std::string where = "not compared: " + of.object + ", " + of.hand + " " + of.grasp;
    if (of.people) {
      table.AddRow({of.object, of.hand, of.grasp, "people", FormatTouches(of.people),
                    FormatMedianGft(of.people), "", "", ""});
    } else if (!comparison.study.empty()) {
      reasons += where + ", people: " + of.people.reason() + "\n";
    }
    for (const ScheduleRow& row : cell.rows) {
      table.AddRow(
          {of.object, of.hand, of.grasp, row.schedule, FormatTouches(row.lags),
           FormatMedianGft(row.lags),
           std::to_string(row.tally.successes()) + " of " + std::to_string(row.tally.finished),
           row.threshold_text.empty() ? "n/a" : row.threshold_text, FormatRatio(row)});
      if (!row.lags) reasons += where + ", " + row.schedule + ": " + row.lags.reason() + "\n";
    }
    for (const std::string& text : DescribeUnknown(cell)) {
      reasons += of.object + ", " + of.hand + " " + of.grasp + ", " + text + "\n";
    }
    for (const auto& [schedule, reason] : of.missing) {
      if (comparison.study.empty() && schedule == kPeopleLike) continue;
      if (!of.people && schedule == kPeopleLike) continue;  // said above
      reasons += where + ", " + schedule + ": " + reason + "\n";
    }
  }
  return table.Format() + reasons +
         "medians over trials; thresholds are margins; ratio: to the natural schedule, draw by "
         "draw, with 95 % interval (six draws or more)\n";
}

std::string FormatMap(const MapResult& result) {
  std::string text;
  for (const std::string& finding : result.findings()) text += finding + "\n";
  std::vector<MapRow> rows;
  for (const MapRow& row : ListMapRows(result)) {
    if (row.cell->where.size() < 2 && row.cell->late == LateDigit::kLast) rows.push_back(row);
  }
  return text + "\n" + FormatTable(ShowRegions(rows)) +
         "means over pairs with 95 % intervals from resampling objects; verdicts at a false "
         "discovery rate of 5 %\n";
}

std::string FormatSweepTables(const SweepSummary& summary) {
  std::string text =
      FormatTable(ShowConditions(summary)) + "success: rate; other columns: medians\n\n" +
      FormatTable(ShowEffects(summary.effects)) +
      "relative to the base level, on the same draws; intervals from resampling objects\n";
  const std::vector<SweepEffect> interactions = summary.FindInteractions();
  if (!interactions.empty()) {
    text += "\nsignificant interactions (95 % CI excludes 0)\n" +
            FormatTable(ShowEffects(interactions));
  } else if (!summary.interactions.empty()) {
    text += "no significant interaction (95 % CI)\n";
  }
  if (summary.thresholds.empty()) return text;
  return text + "\n" + FormatTable(ShowThresholds(summary)) +
         "not monotone: draws that fail again with a larger grip\n";
}

std::string FormatRelations(const std::vector<SimultaneityRelation>& relations) {
  const bool is_any = std::any_of(relations.begin(), relations.end(),
                                  [](const auto& row) { return row.relation.has_value(); });
  if (!is_any) {
    return "not testable: no condition (hand, object, grasp) has three trials that differ in the "
           "compared measures; run more trials per condition\n";
  }
  return FormatTable(ShowRelations(relations)) +
         "within conditions (hand, object, grasp), with 95 % intervals; p of all: over all rows "
         "(Holm)\n";
}

std::string FormatDoseResponses(const std::vector<DoseResponse>& rows) {
  const bool leaves_out =
      std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.num_left_out > 0; });
  return FormatTable(ShowDoses(rows)) +
         (leaves_out ? "n of N trials: the others lack a value at some delay\n" : "") +
         "the same draws with one digit delayed; 95 % intervals from resampling objects; all "
         "measures except success, push and turn: trials that succeed at every delay\n";
}

std::string FormatNumericsTables(const std::vector<NumericsSummary>& summaries,
                                 const std::vector<NumericsComparison>& comparisons) {
  const auto count = [&](int NumericsSummary::*member) {
    int sum = 0;
    for (const NumericsSummary& summary : summaries) sum += summary.*member;
    return sum;
  };
  std::string text = FormatTable(ShowVariants(summaries));
  if (count(&NumericsSummary::num_left_out) > 0) {
    text +=
        "n of N trials: the others are unfinished, or the variant's backend does not support the "
        "object\n";
  }
  text +=
      "flagged: held, but reseated or caged; above 10 %: change of grip, sigma or breaking force "
      "in the other held trials\n\n" +
      FormatTable(ShowSeatChanges(summaries)) + "median (largest) change per seat\n";
  const int num_failures = count(&NumericsSummary::num_numerical_failures);
  if (num_failures > 0) text += FormatCount(num_failures, "numerical failure") + '\n';
  if (count(&NumericsSummary::num_flips) == 0) return text + "\nno verdict flips\n";
  return text + '\n' + FormatTable(ShowFlips(comparisons));
}

}  // namespace graspbench
