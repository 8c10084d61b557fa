#include "workbench/summary_table.h"

#include <algorithm>
#include <vector>

#include "reports/format.h"
#include "workbench/plain_text.h"
#include "workbench/text_table.h"

namespace graspbench {
namespace {

/** "no contact 3, slipped in lift-off 1". */
std::string FormatFailures(const Tally& tally) {
  std::string text;
  for (const Outcome outcome : ListOutcomes()) {
    const int count = tally.CountOf(outcome);
    if (outcome == Outcome::kSuccess || count == 0) continue;
    text += (text.empty() ? "" : ", ") + std::string(NameOf(outcome)) + " " + std::to_string(count);
  }
  return text.empty() ? "none" : text;
}

}  // namespace

std::string FormatSummaryTable(const SessionSummary& summary) {
  TextTable table({"hand", "trials", "successes", "rate", "95 % interval [%]", "failures"});
  for (const std::string& hand : summary.hands) {
    const Tally tally = summary.TallyOf(hand);
    table.AddRow({hand, std::to_string(tally.finished), std::to_string(tally.successes()),
                  tally.finished > 0 ? MakePlainText(FormatPercent(
                                           static_cast<double>(tally.successes()) / tally.finished))
                                     : "n/a",
                  MakePlainText(FormatRateInterval(tally.successes(), tally.finished)),
                  FormatFailures(tally)});
  }
  return table.Format();
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
  return {{"session", folder.string()}, {"report", report.string()}, {"hands", hands}};
}

}  // namespace graspbench
