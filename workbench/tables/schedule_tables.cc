#include "workbench/tables/schedule_tables.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/text/range_text.h"
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

}  // namespace

std::string FormatSchedulePlan(const SchedulePlan& plan) {
  TextTable table({"object", "hand", "grasp", "schedule", "trials", "why none"});
  for (const PlannedSchedule& row : ListPlanned(plan)) {
    table.AddRow({row.of->object, row.of->hand, row.of->grasp, row.name,
                  std::to_string(row.num_trials), row.missing});
  }
  return table.Format() + "and the grip threshold of each draw, which takes several trials more\n";
}

Json ToJson(const SchedulePlan& plan) {
  Json list = Json::array();
  for (const PlannedSchedule& row : ListPlanned(plan)) {
    list.push_back({{"object", row.of->object},
                    {"hand", row.of->hand},
                    {"grasp", row.of->grasp},
                    {"schedule", row.name},
                    {"trials", row.num_trials},
                    {"missing", row.missing}});
  }
  return list;
}

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

}  // namespace graspbench
