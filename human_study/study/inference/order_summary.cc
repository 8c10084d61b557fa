#include "human_study/study/inference/order_summary.h"

#include <algorithm>
#include <map>

namespace graspbench {
namespace {

size_t FindPlace(const std::vector<std::string>& digits, const std::string& digit) {
  return static_cast<size_t>(std::find(digits.begin(), digits.end(), digit) - digits.begin());
}

/** The digit alone in the first group; the number of digits for a tie. */
size_t FindFirst(const ContactOrder& order, const std::vector<std::string>& digits) {
  const bool is_sure = !order.groups.empty() && order.groups.front().size() == 1;
  return is_sure ? FindPlace(digits, order.groups.front().front()) : digits.size();
}

/** Tied digits in the order of the hand: which of them came first is not known. */
std::string FormatOrder(ContactOrder order, const std::vector<std::string>& digits) {
  for (std::vector<std::string>& group : order.groups) {
    std::sort(group.begin(), group.end(), [&](const auto& a, const auto& b) {
      return FindPlace(digits, a) < FindPlace(digits, b);
    });
  }
  return order.Format();
}

void CountFirst(const StudyTrial& trial, const std::vector<std::string>& digits,
                std::vector<FirstDigits>& first) {
  auto row = std::find_if(first.begin(), first.end(), [&](const FirstDigits& other) {
    return other.participant == trial.participant;
  });
  if (row == first.end()) {
    row = first.insert(first.end(), {trial.participant, std::vector<int>(digits.size() + 1, 0)});
  }
  ++row->counts[FindFirst(trial.analysis->order, digits)];
}

void CountPrecedence(const ContactOrder& order, const std::vector<std::string>& digits,
                     std::vector<std::vector<Precedence>>& precedence) {
  for (size_t a = 0; a < digits.size(); ++a) {
    for (size_t b = 0; b < digits.size(); ++b) {
      const int rank_a = order.FindRank(digits[a]), rank_b = order.FindRank(digits[b]);
      if (rank_a == 0 || rank_b == 0) continue;  // one of them never touched
      ++precedence[a][b].num_both;
      precedence[a][b].num_before += rank_a < rank_b;
    }
  }
}

}  // namespace

OrderSummary SummariseOrders(const StudyResult& result) {
  const std::vector<std::string>& digits = result.digits;
  OrderSummary summary;
  summary.precedence.assign(digits.size(), std::vector<Precedence>(digits.size()));
  std::map<std::string, int> counts;
  for (const StudyTrial& trial : result.trials) {
    if (!trial.IsKept()) continue;
    const ContactOrder& order = trial.analysis->order;
    CountFirst(trial, digits, summary.first);
    CountPrecedence(order, digits, summary.precedence);
    ++counts[FormatOrder(order, digits)];
    summary.num_ties += order.num_ties;
    summary.num_neighbours += std::max(0, trial.analysis->num_touching - 1);
  }
  for (const auto& [order, count] : counts) {
    summary.orders.push_back({order, count, CalcShare(count, result.CountKept())});
  }
  std::stable_sort(summary.orders.begin(), summary.orders.end(),
                   [](const OrderCount& a, const OrderCount& b) { return a.count > b.count; });
  return summary;
}

}  // namespace graspbench
