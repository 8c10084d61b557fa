#include "datasets/analysis/session_comparison.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

std::set<std::string> ListHands(const Session& session) {
  std::set<std::string> hands;
  for (const TrialRecord& record : session.records) hands.insert(record.plan.hand);
  return hands;
}

std::string ExplainNoPair(const Session& before, const Session& after) {
  if (before.records.empty() || after.records.empty()) {
    return "one of the sessions has no finished trial";
  }
  const auto differ = [](const std::string& what, const auto& a, const auto& b) {
    return what + ": " + FormatJson(a) + " and " + FormatJson(b);
  };
  const SessionConfig &a = before.config, &b = after.config;
  if (a.seed != b.seed) return differ("they have different seeds", a.seed, b.seed);
  if (a.variation.offset != b.variation.offset || a.variation.yaw != b.variation.yaw) {
    return "they vary the object pose differently (variation.offset_m, variation.yaw_rad)";
  }
  const auto list_keys = [](const Session& session) {
    std::set<std::string> keys;
    for (const TrialRecord& record : session.records) {
      const PlannedTrial& plan = record.plan;
      keys.insert(MakePlainKey({plan.hand, plan.object, plan.grasp}) +
                  (plan.condition ? "@" + *plan.condition : ""));
    }
    return keys;
  };
  return differ("they have no condition (hand, object, grasp, setting) in common",
                list_keys(before), list_keys(after));
}

}  // namespace

int SessionComparison::num_other_grasp() const {
  return static_cast<int>(std::count_if(
      pairs.begin(), pairs.end(), [](const TrialPair& pair) { return pair.changes_grasp(); }));
}

SessionComparison CompareSessions(const Session& before, const Session& after) {
  const std::set<std::string> hands = ListHands(before), other_hands = ListHands(after);
  const bool is_any_hand = hands.size() == 1 && other_hands.size() == 1;
  std::set<std::optional<std::string>> conditions;
  for (const PlannedTrial& planned : before.plan) conditions.insert(planned.condition);
  SessionComparison comparison;
  const bool has_two_hands = is_any_hand && hands != other_hands;
  if (has_two_hands) {
    comparison.hand = *hands.begin();
    comparison.other_hand = *other_hands.begin();
  }
  VariedTrials trials;
  for (const std::optional<std::string>& condition : conditions) {
    const ComparedSide sides[] = {{&before, condition}, {&after, condition}};
    for (const ComparedDraw& draw : ListComparedDraws({sides[0], sides[1]}, is_any_hand)) {
      if (draw.planned[0]) trials[draw.planned[0]->id];
      if (!draw.records[0] || !draw.records[1]) continue;
      comparison.pairs.push_back({draw.records[0], draw.records[1]});
      trials[draw.planned[0]->id] = MakeTrialMeasures(*draw.records[1]);
    }
  }
  if (comparison.pairs.empty()) {
    throw Error(ErrorKind::kUsage, "no trial of the two sessions was run on the same draw: " +
                                       ExplainNoPair(before, after));
  }
  std::sort(comparison.pairs.begin(), comparison.pairs.end(),
            [](const TrialPair& a, const TrialPair& b) { return a.before < b.before; });
  const int num_pairs = static_cast<int>(comparison.pairs.size());
  comparison.num_only_before = static_cast<int>(before.records.size()) - num_pairs;
  comparison.num_only_after = static_cast<int>(after.records.size()) - num_pairs;
  for (SettingChange& change : ListChanges(before, "all pairs", trials)) {
    comparison.changes.push_back(std::move(change));
    if (has_two_hands) {
      comparison.changes.back().num_other_grasp = 0;
      continue;
    }
    const int num_other = comparison.changes.back().num_other_grasp;
    if (num_other == 0 || num_other == comparison.changes.back().successes.num_pairs()) continue;
    const std::string hand = comparison.changes.back().hand;
    for (SettingChange& same : ListChanges(before, "same grasp", trials, PairsTaken::kSameGrasp)) {
      if (same.hand == hand) comparison.changes.push_back(std::move(same));
    }
  }
  comparison.settings = FindConfigDifferences(before.config, after.config);
  return comparison;
}

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
    if (pair.before->plan.hand != hand) continue;
    const bool has_both = a != first.end() && b != second.end();
    ++(has_both ? change.num_pairs : change.num_left_out);
    if (!has_both) continue;
    change.num_lower += b->second < a->second;
    change.num_equal += b->second == a->second;
    change.num_higher += b->second > a->second;
    const bool is_infinite = std::isinf(a->second) || std::isinf(b->second);
    change.num_infinite += is_infinite;
    if (!is_infinite) ratios.push_back(b->second / a->second);
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

std::vector<CsvColumn<ThresholdChange>> ListThresholdChangeColumns() {
  using Row = ThresholdChange;
  using C = CsvColumn<Row>;
  return {
      C("scale", "", "", [](const Row& row) { return row.scale->name; }).Shown("grip threshold"),
      C("hand", "", "", &Row::hand).Shown("hand"),
      C("pairs", "", "", &Row::num_pairs)
          .Shown("pairs",
                 [](const Row& row) {
                   return FormatCountOf(row.num_pairs, row.num_pairs + row.num_left_out);
                 }),
      C("lower", "", "", &Row::num_lower).Shown("lower"),
      C("equal", "", "", &Row::num_equal).Shown("equal"),
      C("higher", "", "", &Row::num_higher).Shown("higher"),
      C("ratio", "", "", &Row::ratio)
          .Shown("second over first",
                 [](const Row& row) {
                   return FormatWithRange(row.ratio, row.low, row.high, 2) +
                          (row.num_infinite == 0
                               ? ""
                               : ", " + std::to_string(row.num_pairs - row.num_infinite) + " of " +
                                     FormatCount(row.num_pairs, "pair"));
                 }),
      {"ratio_low", "", "", &Row::low},
      {"ratio_high", "", "", &Row::high},
      {"left_out", "", "", &Row::num_left_out},
      {"infinite", "", "", &Row::num_infinite}};
}

}  // namespace graspbench
