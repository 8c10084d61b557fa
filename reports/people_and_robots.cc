#include "reports/people_and_robots.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "reports/plots/line_plot.h"

namespace graspbench {
namespace {

constexpr size_t kNumUnfolded = 4;
constexpr char kPeopleRow[] = "people";

/** "TUM Hand, can, power (g3)". */
std::string NameScheduleCell(const PeopleOnObject& of, const SessionModels& models) {
  return models.NameOfHand(of.hand) + ", " + models.NameOfObject(of.object) + ", " +
         NameOfGrasp(of.grasp);
}

std::string FormatTouchShare(double share) {
  return std::isinf(share) ? "never" : FormatFixed(100.0 * share, 1);
}

/** One row for `who` touches; a quartile that is never reached appears only in the text. */
IntervalPlot::Row MakeTouchRow(const std::string& who, int series, const Answer<TouchLags>& lags,
                               const std::string& digit) {
  IntervalPlot::Row row;
  row.label = who;
  row.series = series;
  row.value = row.low = row.high = kUnset;
  if (!lags) {
    row.text = "not compared";
    return row;
  }
  const DigitShare& share = lags->Of(digit);
  const auto place = [](double value) { return std::isinf(value) ? kUnset : 100.0 * value; };
  row.value = place(share.median);
  row.low = place(share.low);
  row.high = place(share.high);
  row.text = FormatTouchShare(share.median) + " (" + FormatTouchShare(share.low) + " to " +
             FormatTouchShare(share.high) + ")";
  if (share.num_never > 0) {
    row.text += ", " + std::to_string(share.num_never) + " of " + std::to_string(lags->num_trials) +
                " never";
  }
  return row;
}

Html DrawScheduleCell(const ScheduleCell& cell, const SessionModels& models) {
  IntervalPlot plot;
  plot.text.title = "When digits touch: " + NameScheduleCell(cell.of, models);
  plot.text.description =
      "First contact of each digit relative to the first digit: median and quartiles over trials, "
      "for participants and each schedule.";
  plot.axis = "delay after the first contact [% of the closing time]";
  for (const std::string& digit : cell.of.digits) {
    plot.AddHeading(models.NameOfDigit(cell.of.hand, digit));
    if (cell.of.people) plot.rows.push_back(MakeTouchRow(kPeopleRow, 1, cell.of.people, digit));
    for (const ScheduleRow& row : cell.rows) {
      const int series = row.schedule == kNatural ? 0 : row.schedule == kSimultaneous ? 2 : 3;
      plot.rows.push_back(MakeTouchRow(row.schedule, series, row.lags, digit));
    }
  }
  return MakeFigure(plot.text.title + ".",
                    "order and spacing of the digits in participants and robots; a digit that "
                    "never touches counts as last.",
                    MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

Html DrawScheduleFigures(const ScheduleComparison& comparison, const SessionModels& models) {
  Html shown, folded;
  int num_folded = 0;
  for (size_t i = 0; i < comparison.cells.size(); ++i) {
    if (comparison.cells[i].of.digits.empty()) continue;
    const Html figure = DrawScheduleCell(comparison.cells[i], models);
    (i < kNumUnfolded ? shown : folded) += figure;
    num_folded += i < kNumUnfolded ? 0 : 1;
  }
  if (num_folded == 0) return shown;
  return shown + MakeDetails(FormatCount(num_folded, "more condition"), folded);
}

std::string FormatScheduleGft(const Answer<TouchLags>& lags) {
  return lags && std::isfinite(lags->gft) ? FormatFixed(MsFromS(lags->gft), 0) : "n/a";
}

std::string FormatScheduleCost(const ScheduleRow& row) {
  if (!row.missed.empty()) return "misses its label";
  if (std::isnan(row.ratio)) return "n/a";
  const Interval range = row.interval.value_or(Interval{kUnset, kUnset});
  return FormatWithRange(row.ratio, range.low, range.high, 2);
}

Html DrawScheduleCosts(const ScheduleComparison& comparison, const SessionModels& models) {
  Table table("Cost of each schedule, on the same draws.",
              {"Condition",
               "Schedule",
               "Trials",
               {"GFT [ms]", "median; n/a: a digit does not touch in at least half of the trials"},
               "Held",
               {"Threshold margin", "median grip threshold over draws (margin)"},
               {"Pairs", "draws with a threshold under this and the natural schedule"},
               {"Of natural",
                "ratio of thresholds to the natural schedule: median, 95 % interval; 1: no cost"}});
  for (const ScheduleCell& cell : comparison.cells) {
    const std::string name = NameScheduleCell(cell.of, models);
    if (cell.of.people) {
      table.AddRow({name, kPeopleRow, cell.of.people->num_trials, FormatScheduleGft(cell.of.people),
                    "n/a", "n/a", "n/a", "n/a"});
    }
    for (const ScheduleRow& row : cell.rows) {
      table.AddRow({name, row.schedule, row.tally.finished, FormatScheduleGft(row.lags),
                    row.tally.successes(), row.threshold_text.empty() ? "n/a" : row.threshold_text,
                    row.num_pairs, FormatScheduleCost(row)});
    }
  }
  return table.ToHtml();
}

Html DrawNotCompared(const ScheduleComparison& comparison, const SessionModels& models) {
  std::vector<std::string> reasons;
  for (const ScheduleCell& cell : comparison.cells) {
    const std::string name = "not compared: " + NameScheduleCell(cell.of, models) + ", ";
    if (!cell.of.people && !comparison.study.empty()) {
      reasons.push_back(name + "people: " + cell.of.people.reason());
    }
    for (const ScheduleRow& row : cell.rows) {
      if (!row.lags) reasons.push_back(name + row.schedule + ": " + row.lags.reason());
    }
    for (const std::string& text : DescribeUnknown(cell)) {
      reasons.push_back(NameScheduleCell(cell.of, models) + ", " + text);
    }
    for (const auto& [schedule, reason] : cell.of.missing) {
      if (cell.of.people || schedule != kPeopleLike) {
        reasons.push_back(name + schedule + ": " + reason);
      }
    }
  }
  return reasons.empty() ? Html() : MakeList(reasons);
}

}  // namespace

Html DrawPeopleAndRobots(const ScheduleComparison& comparison, const SessionModels& models) {
  const bool has_people = !comparison.study.empty();
  const std::string text =
      "Contact times are relative to the first contact, as shares of the closing time, because a "
      "robot closes at a set speed. Only the digits of the robot's grasp are compared. " +
      (has_people ? "People: " + comparison.study + "." : "No study of participants was named.") +
      " The delays of simultaneous and people-like closing are determined in a trial without "
      "variation; the sampled object pose spreads the contacts again.";
  return MakeParagraph(text) + DrawScheduleFigures(comparison, models) +
         DrawScheduleCosts(comparison, models) + DrawNotCompared(comparison, models);
}

Html DrawSchedules(const std::vector<ScheduleComparison>& comparisons, const SessionModels& models,
                   const std::string& session) {
  if (comparisons.empty()) {
    return MakeParagraph("Only the natural schedule was run. graspbench simultaneity " + session +
                         " --schedules --people STUDY adds simultaneous and people-like closing "
                         "and their cost in grip threshold.");
  }
  Html html;
  for (const ScheduleComparison& comparison : comparisons) {
    if (comparisons.size() > 1) html += MakeParagraph("In " + comparison.folder + ":");
    html += DrawPeopleAndRobots(comparison, models);
  }
  return html;
}

}  // namespace graspbench
