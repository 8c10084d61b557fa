#include "workbench/tables/summary_table.h"

#include <algorithm>
#include <vector>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/statistics/proportion.h"
#include "datasets/analysis/grip_summary.h"
#include "datasets/session/judgement_store.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/run_session.h"
#include "workbench/tables/text_table.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {
namespace {

/** One row per kind of failure that happened, one column per hand; empty without failures. */
std::string FormatFailures(const SessionSummary& summary) {
  std::vector<std::string> head = {"failures"};
  head.insert(head.end(), summary.hands.begin(), summary.hands.end());
  TextTable table(head);
  bool is_empty = true;
  for (const Outcome outcome : ListOutcomes()) {
    if (outcome == Outcome::kSuccess || summary.total.CountOf(outcome) == 0) continue;
    std::vector<std::string> row = {NameOf(outcome)};
    for (const std::string& hand : summary.hands) {
      row.push_back(std::to_string(summary.TallyOf(hand).CountOf(outcome)));
    }
    table.AddRow(row);
    is_empty = false;
  }
  return is_empty ? "" : "\n" + table.Format();
}

/** Of cells with two seats or a caged grasp, the others have one grip force; empty without. */
std::string FormatSeats(const SessionSummary& summary) {
  const std::vector<SeatSummary> seats = ListSeats(summary);
  std::vector<SeatSummary> shown;
  std::copy_if(seats.begin(), seats.end(), std::back_inserter(shown), [&](const SeatSummary& seat) {
    const auto is_of_cell = [&](const SeatSummary& other) { return other.cell == seat.cell; };
    return seat.num_caged > 0 || std::count_if(seats.begin(), seats.end(), is_of_cell) > 1;
  });
  return shown.empty() ? ""
                       : "\n" + DescribeSeats(seats) + "; medians, lowest to highest\n" +
                             FormatTable(ShowSeats(shown));
}

}  // namespace

std::string FormatSummaryTable(const SessionSummary& summary) {
  TextTable table({"hand", "trials", "successes", "rate", "95 % interval [%]"});
  for (const std::string& hand : summary.hands) {
    const Tally tally = summary.TallyOf(hand);
    table.AddRow({hand, std::to_string(tally.finished), std::to_string(tally.successes()),
                  tally.finished > 0 ? MakePlainText(FormatPercent(tally.rate())) : "n/a",
                  MakePlainText(FormatRateInterval(tally.successes(), tally.finished))});
  }
  std::string differences;
  for (const HandDifference& difference : summary.differences) {
    differences += (differences.empty() ? "\n" : "") +
                   DescribeHandDifference(difference, difference.hand, difference.other) + "\n";
  }
  const GripShortfall shortfall = FindShortfall(summary);
  std::string grip;
  for (const std::string& line : {DescribeShortfall(shortfall), DescribeExcess(shortfall)}) {
    if (!line.empty()) grip += (grip.empty() ? "\n" : "") + line + "\n";
  }
  return table.Format() + differences + FormatFailures(summary) + FormatSeats(summary) + grip;
}

Json MakeSummaryJson(const SessionSummary& summary, const std::filesystem::path& folder,
                     const std::filesystem::path& report) {
  Json hands = Json::array();
  for (const std::string& hand : summary.hands) {
    const Tally tally = summary.TallyOf(hand);
    Json outcomes = Json::object();
    for (const Outcome outcome : ListOutcomes()) outcomes[NameOf(outcome)] = tally.CountOf(outcome);
    hands.push_back({{"hand", hand},
                     {"trials", tally.finished},
                     {"successes", tally.successes()},
                     {"outcomes", outcomes}});
  }
  return {{"session", folder.string()},
          {"report", report.string()},
          {"hands", hands},
          {"differences", ToJson(summary.differences)},
          {"seats", ToJson(ListSeats(summary))}};
}

std::string DescribeRest(const Session& session) {
  const size_t num_left = FindTrialRound(session.config).find_left(session).size();
  if (num_left > 0) return FormatCount(static_cast<int64_t>(num_left), "trial is", "trials are");
  const size_t num_unjudged = HasBegunJudge(session.folder) ? FindUnjudged(session).size() : 0;
  if (num_unjudged == 0) return "";
  return FormatCount(static_cast<int64_t>(num_unjudged), "held grasp to judge is",
                     "held grasps to judge are");
}

}  // namespace graspbench
