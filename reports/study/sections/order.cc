#include "core/base/text/text.h"
#include "human_study/study/inference/study_statistics.h"
#include "reports/plots/svg_plot.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

constexpr size_t kMaxOrders = 6;

Html DrawFirstDigits(const OrderSummary& summary, const std::vector<std::string>& digits) {
  StackedBars plot;
  plot.text.title = "First digit to touch, by participant";
  plot.text.description =
      "Share of trials in which each digit touched first, beyond the uncertainty of its time.";
  for (const std::string& digit : digits) plot.classes.push_back({NameOfDigit(digit), digit});
  plot.classes.push_back({"not resolved", "="});
  for (const FirstDigits& row : summary.first) {
    plot.rows.push_back({row.participant, "", row.counts});
  }
  return MakeFigure(
      "First digit to touch, by participant. In a tie two times differ by less than 1.96 standard "
      "uncertainties.",
      "patterns of individual persons; ties cannot be resolved by the recording.",
      MakeScroll("First digit to touch", DrawStackedBars(plot)));
}

/** Maps how often each digit touched before each other digit. */
Html DrawPrecedence(const OrderSummary& summary, const std::vector<std::string>& digits) {
  HeatMap map;
  map.text.title = "Pairwise order of contact";
  map.text.description = "Share of trials in which the row's digit touched before the column's.";
  for (const std::string& digit : digits) map.rows.push_back(NameOfDigit(digit));
  map.columns = map.rows;
  for (size_t row = 0; row < digits.size(); ++row) {
    for (size_t column = 0; column < digits.size(); ++column) {
      const Precedence& precedence = summary.precedence[row][column];
      HeatMap::Cell cell;
      if (precedence.num_before > 0) {
        cell.rate = precedence.share();
        cell.text = FormatPercent(cell.rate);
        cell.hint = map.rows[row] + " before " + map.columns[column] + ": " +
                    std::to_string(precedence.num_before) + " of " +
                    FormatCount(precedence.num_both, "trial");
      }
      map.cells.push_back(cell);
    }
  }
  return MakeFigure(
      "Share of trials in which the row's digit touched before the column's, ties not counted; "
      "what is missing to 100 % between a cell and its mirror image is tied; empty: never.",
      "large shares above the diagonal: contacts proceed from the radial to the ulnar side.",
      MakeScroll(map.text.title, DrawHeatMap(map)));
}

Html DrawOrders(const OrderSummary& summary) {
  Table table("Orders of contact, most frequent first; = joins digits that are tied.",
              {"Order", "Trials", "Share [%]"});
  const std::vector<OrderCount>& orders = summary.orders;
  for (size_t i = 0; i < orders.size() && i < kMaxOrders; ++i) {
    table.AddRow({Element("code", {}, orders[i].order), orders[i].count,
                  FormatFixed(100.0 * orders[i].share, 1)});
  }
  std::string text = std::to_string(summary.num_ties) + " of " +
                     FormatCount(summary.num_neighbours, "pair") + " of neighbours are tied.";
  if (orders.size() > kMaxOrders) {
    text += " " + std::to_string(orders.size() - kMaxOrders) + " rarer orders are in measures.csv.";
  }
  return table.ToHtml() + MakeParagraph(text);
}

Html DrawOrder(const StudyPageData& data) {
  if (data.result.CountKept() == 0) return MakeParagraph("No trial counts.");
  const OrderSummary summary = SummariseOrders(data.result);
  const std::vector<std::string>& digits = data.result.digits;
  return DrawFirstDigits(summary, digits) + DrawPrecedence(summary, digits) + DrawOrders(summary);
}

}  // namespace

StudySection order_study_section() { return {"order", "Order of contact", DrawOrder}; }

}  // namespace graspbench
