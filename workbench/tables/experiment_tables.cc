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
         "and the grip threshold of each draw, which takes several trials more\n";
}

Json ToJson(const SchedulePlan& plan) { return MakeJsonRows(ListPlanColumns(), ListPlanned(plan)); }

std::string FormatSchedules(const ScheduleComparison& comparison) {
  TextTable table({"object", "hand", "grasp", "schedule", "touches after the first [% of closing]",
                   "GFT [ms]", "held", "threshold", "of natural"});
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
         "medians over trials; thresholds are margins, and beside them the ratio to the natural "
         "schedule's, draw by draw, with its 95 % interval (of six draws or more)\n";
}

std::string FormatMap(const MapResult& result) {
  std::string text;
  for (const std::string& finding : result.findings()) text += finding + "\n";
  std::vector<MapRow> rows;
  for (const MapRow& row : ListMapRows(result)) {
    if (row.cell->where.size() < 2 && row.cell->late == LateDigit::kLast) rows.push_back(row);
  }
  return text + "\n" + FormatTable(ShowRegions(rows)) +
         "means over pairs with 95 % intervals from drawing objects; verdicts at a false discovery "
         "rate of 5 %\n";
}

std::string FormatSweepTables(const SweepSummary& summary) {
  std::string text =
      FormatTable(ShowConditions(summary)) + "rate of success, medians of the rest\n\n" +
      FormatTable(ShowEffects(summary.effects)) +
      "against the base's level, on the same draws; intervals from drawing objects\n";
  const std::vector<SweepEffect> interactions = summary.FindInteractions();
  if (!interactions.empty()) {
    text += "\ninteractions whose interval excludes 0\n" + FormatTable(ShowEffects(interactions));
  } else if (!summary.interactions.empty()) {
    text += "no interval of an interaction excludes 0\n";
  }
  if (summary.thresholds.empty()) return text;
  return text + "\n" + FormatTable(ShowThresholds(summary)) +
         "not monotone: trials that fail again with a larger grip\n";
}

std::string FormatRelations(const std::vector<SimultaneityRelation>& relations) {
  const bool is_any = std::any_of(relations.begin(), relations.end(),
                                  [](const auto& row) { return row.relation.has_value(); });
  if (!is_any) {
    return "no relation can be found: no condition (hand, object, grasp) has three trials or more "
           "that differ in what is compared; run more trials of each\n";
  }
  return FormatTable(ShowRelations(relations)) +
         "within conditions (hand, object, grasp), with 95 % intervals; p of all: over all rows "
         "(Holm)\n";
}

std::string FormatDoseResponses(const std::vector<DoseResponse>& rows) {
  const bool leaves_out =
      std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.num_left_out > 0; });
  return FormatTable(ShowDoses(rows)) +
         (leaves_out ? "n of N trials: the others have no value at some delay\n" : "") +
         "the same trials on the same draws with one digit late; 95 % intervals from drawing "
         "objects; all but success, pushes and turns are of trials that succeed at every "
         "delay\n";
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
        "n of N trials: the others are not finished, or the variant's backend cannot move them\n";
  }
  text +=
      "flagged: held, but reseated or caged; above 10 %: grip, sigma or breaking force of the "
      "other held\n\n" +
      FormatTable(ShowSeatChanges(summaries)) + "median (largest) of each seat\n";
  const int num_failures = count(&NumericsSummary::num_numerical_failures);
  if (num_failures > 0) text += FormatCount(num_failures, "numerical failure") + '\n';
  if (count(&NumericsSummary::num_flips) == 0) return text + "\nno verdict flips\n";
  return text + '\n' + FormatTable(ShowFlips(comparisons));
}

}  // namespace graspbench
