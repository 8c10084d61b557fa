#include <algorithm>
#include <map>

#include "core/base/text.h"
#include "reports/study/study_section.h"
#include "reports/svg_plot.h"

namespace graspbench {
namespace {

constexpr size_t kMaxOrders = 6;

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
  plot.classes.push_back({"cannot be told apart", "="});
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

/** How often one digit touched before another, for every two. */
Html DrawPrecedence(const StudyResult& result) {
  HeatMap map;
  map.text.title = "Which digit touched before which";
  map.text.description = "Share of trials in which the row's digit touched before the column's.";
  for (const std::string& digit : result.digits) map.rows.push_back(NameOfDigit(digit));
  map.columns = map.rows;
  for (const std::string& row : result.digits) {
    for (const std::string& column : result.digits) {
      int num_before = 0, num_both = 0;
      for (const StudyTrial& trial : result.trials) {
        if (!trial.IsKept()) continue;
        const int a = trial.analysis->order.FindRank(row);
        const int b = trial.analysis->order.FindRank(column);
        if (a == 0 || b == 0) continue;  // one of them never touched
        ++num_both;
        num_before += a < b;
      }
      HeatMap::Cell cell;
      if (num_before > 0) {
        cell.rate = static_cast<double>(num_before) / num_both;
        cell.text = FormatPercent(cell.rate);
        cell.hint = NameOfDigit(row) + " before " + NameOfDigit(column) + ": " +
                    std::to_string(num_before) + " of " + FormatCount(num_both, "trial");
      }
      map.cells.push_back(cell);
    }
  }
  return MakeFigure(
      "Share of trials in which the row's digit touched before the column's, ties not counted; "
      "what is missing to 100 % between a cell and its mirror image is tied; empty: never.",
      "large shares above the diagonal: contacts run from the radial to the ulnar side.",
      MakeScroll(map.text.title, DrawHeatMap(map)));
}

/** Tied digits in the order of the hand: which of them came first is not known. */
std::string FormatOrder(ContactOrder order, const std::vector<std::string>& digits) {
  const auto place_of = [&](const std::string& digit) {
    return std::find(digits.begin(), digits.end(), digit);
  };
  for (std::vector<std::string>& group : order.groups) {
    std::sort(group.begin(), group.end(),
              [&](const auto& a, const auto& b) { return place_of(a) < place_of(b); });
  }
  return order.Format();
}

Html DrawOrders(const StudyResult& result) {
  std::map<std::string, int> counts;
  int num_ties = 0, num_neighbours = 0;
  for (const StudyTrial& trial : result.trials) {
    if (!trial.IsKept()) continue;
    ++counts[FormatOrder(trial.analysis->order, result.digits)];
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

Html DrawOrder(const StudyPageData& data) {
  if (data.result.CountKept() == 0) return MakeParagraph("No trial counts.");
  return DrawFirstDigits(data.result) + DrawPrecedence(data.result) + DrawOrders(data.result);
}

}  // namespace

StudySection order_study_section() { return {"order", "Order of contact", DrawOrder}; }

}  // namespace graspbench
