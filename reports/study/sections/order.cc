#include <algorithm>
#include <map>

#include "reports/format.h"
#include "reports/study/study_section.h"
#include "reports/svg_plot.h"

namespace graspbench {
namespace {

constexpr size_t kMaxOrders = 12;

/** Who is sure to have touched first: the digit alone in the first group; empty for a tie. */
std::string FindFirst(const ContactOrder& order) {
  if (order.groups.empty() || order.groups.front().size() != 1) return "";
  return order.groups.front().front();
}

Html DrawFirstDigits(const StudyResult& result) {
  StackedBars plot;
  plot.text.title = "First digit to touch, by participant";
  plot.text.description =
      "Share of trials in which each digit touched first, beyond the uncertainty of its time.";
  for (const std::string& digit : result.digits) {
    plot.classes.push_back({NameOfDigit(digit), digit});
  }
  plot.classes.push_back({"cannot be told apart", "TI"});
  for (const StudyTrial& trial : result.trials) {
    if (!trial.IsKept()) continue;
    auto row = std::find_if(plot.rows.begin(), plot.rows.end(),
                            [&](const auto& r) { return r.label == trial.participant; });
    if (row == plot.rows.end()) {
      row = plot.rows.insert(plot.rows.end(),
                             {trial.participant, "", std::vector<int>(plot.classes.size(), 0)});
    }
    const std::string first = FindFirst(trial.analysis->order);
    const auto digit = std::find(result.digits.begin(), result.digits.end(), first);
    ++row->counts[static_cast<size_t>(digit - result.digits.begin())];
  }
  return MakeFigure(
      "Which digit touched first, trials of each participant. A tie is two digits "
      "whose times differ by less than 1.96 standard uncertainties.",
      "patterns that are a person's own; ties are what the recording cannot decide.",
      MakeScroll("First digit to touch", DrawStackedBars(plot)));
}

Html DrawOrders(const StudyResult& result) {
  std::map<std::string, int> counts;
  int num_ties = 0, num_neighbours = 0;
  for (const StudyTrial& trial : result.trials) {
    if (!trial.IsKept()) continue;
    ++counts[trial.analysis->order.Format()];
    num_ties += trial.analysis->order.num_ties;
    num_neighbours += std::max(0, trial.analysis->num_touching - 1);
  }
  std::vector<std::pair<std::string, int>> orders(counts.begin(), counts.end());
  std::stable_sort(orders.begin(), orders.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  Table table("Orders of contact, most frequent first; = joins digits that are tied.",
              {{"Order"}, {"Trials", Align::kNumber}, {"Share [%]", Align::kNumber}});
  for (size_t i = 0; i < orders.size() && i < kMaxOrders; ++i) {
    table.AddRow({Element("code", {}, orders[i].first), Text(std::to_string(orders[i].second)),
                  Text(FormatFixed(100.0 * orders[i].second / result.CountKept(), 1))});
  }
  std::string text = std::to_string(num_ties) + " of " + FormatCount(num_neighbours, "pair") +
                     " of neighbours are tied.";
  if (orders.size() > kMaxOrders) {
    text += " " + std::to_string(orders.size() - kMaxOrders) + " rarer orders are in measures.csv.";
  }
  return table.ToHtml() + MakeParagraph(text);
}

Html Draw(const StudyPageData& data) {
  if (data.result.CountKept() == 0) return MakeParagraph("No trial counts.");
  return DrawFirstDigits(data.result) + DrawOrders(data.result);
}

}  // namespace

StudySection order_study_section() { return {"order", "Order of contact", Draw}; }

}  // namespace graspbench
