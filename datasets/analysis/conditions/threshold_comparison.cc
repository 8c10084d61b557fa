#include "datasets/analysis/conditions/threshold_comparison.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/statistics/summary.h"

namespace graspbench {
namespace {

/** Finished draws by the id of the session's trial. */
std::map<std::string, double> ListValues(const ThresholdSummary& summary) {
  std::map<std::string, double> values;
  for (const DrawThreshold& draw : summary.draws) {
    if (!std::isnan(draw.value)) values[draw.draw.id] = draw.value;
  }
  return values;
}

ThresholdChange CompareHand(const std::vector<TrialPair>& pairs, const std::string& hand,
                            const ThresholdSummary& before, const ThresholdSummary& after) {
  ThresholdChange change;
  change.scale = before.scale;
  change.hand = hand;
  const auto first = ListValues(before), second = ListValues(after);
  std::vector<double> ratios;
  for (const TrialPair& pair : pairs) {
    const auto a = first.find(pair.before->plan.id);
    const auto b = second.find(pair.after->plan.id);
    if (pair.before->plan.hand != hand || a == first.end() || b == second.end()) continue;
    ++change.num_pairs;
    change.num_lower += b->second < a->second;
    change.num_equal += b->second == a->second;
    change.num_higher += b->second > a->second;
    if (!std::isinf(a->second) && !std::isinf(b->second)) ratios.push_back(b->second / a->second);
  }
  if (ratios.empty()) return change;
  change.ratio = CalcMedian(ratios);
  if (const auto interval = CalcMedianInterval(ratios)) {
    change.low = interval->low;
    change.high = interval->high;
  }
  return change;
}

}  // namespace

std::vector<ThresholdChange> CompareThresholds(const std::vector<TrialPair>& pairs,
                                               const std::vector<ThresholdSummary>& before,
                                               const std::vector<ThresholdSummary>& after) {
  std::vector<std::string> hands;
  for (const TrialPair& pair : pairs) {
    const std::string& hand = pair.before->plan.hand;
    if (std::find(hands.begin(), hands.end(), hand) == hands.end()) hands.push_back(hand);
  }
  std::vector<ThresholdChange> changes;
  for (const ThresholdSummary& first : before) {
    for (const ThresholdSummary& second : after) {
      if (first.scale != second.scale) continue;
      for (const std::string& hand : hands) {
        ThresholdChange change = CompareHand(pairs, hand, first, second);
        if (change.num_pairs > 0) changes.push_back(std::move(change));
      }
    }
  }
  return changes;
}

Json ToJson(const std::vector<ThresholdChange>& changes) {
  Json list = Json::array();
  for (const ThresholdChange& change : changes) {
    list.push_back({{"scale", change.scale->name},
                    {"hand", change.hand},
                    {"pairs", change.num_pairs},
                    {"lower", change.num_lower},
                    {"equal", change.num_equal},
                    {"higher", change.num_higher},
                    {"ratio", JsonNumber(change.ratio)},
                    {"ratio_low", JsonNumber(change.low)},
                    {"ratio_high", JsonNumber(change.high)}});
  }
  return list;
}

}  // namespace graspbench
