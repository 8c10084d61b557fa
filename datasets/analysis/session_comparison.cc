#include "datasets/analysis/session_comparison.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

/** What must be the same; an empty hand or grasp is any. */
using PairKey = std::tuple<std::string, std::string, std::string, int, std::string>;

std::set<std::string> ListHands(const Session& session) {
  std::set<std::string> hands;
  for (const TrialRecord& record : session.records) hands.insert(record.plan.hand);
  return hands;
}

/** True when no object is grasped in two ways by one hand. */
bool HasOneGraspEach(const Session& session) {
  std::map<std::pair<std::string, std::string>, std::set<std::string>> grasps;
  for (const TrialRecord& record : session.records) {
    grasps[{record.plan.hand, record.plan.object}].insert(record.plan.grasp);
  }
  for (const auto& [scene, names] : grasps) {
    if (names.size() > 1) return false;
  }
  return true;
}

bool IsSameDraw(const Session& a, const Session& b, const PlannedTrial& planned) {
  const TrialDraw first = MakeObjectDraw(a.config, planned.object, planned.trial);
  const TrialDraw second = MakeObjectDraw(b.config, planned.object, planned.trial);
  return CalcDrawDistance(first, second, 1.0) == 0.0;
}

std::string ExplainNoPair(const Session& before, const Session& after) {
  if (before.records.empty() || after.records.empty()) {
    return "one of the sessions has no finished trial";
  }
  const auto differ = [](const std::string& what, const auto& a, const auto& b) {
    return what + ": " + FormatJson(a) + " and " + FormatJson(b);
  };
  const SessionConfig &a = before.config, &b = after.config;
  if (a.seed != b.seed) return differ("they have other seeds", a.seed, b.seed);
  if (a.variation.offset != b.variation.offset || a.variation.yaw != b.variation.yaw) {
    return "they vary the object's place by other amounts (variation.offset_m, variation.yaw_rad)";
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

SessionComparison CompareSessions(const Session& before, const Session& after) {
  const auto hands_before = ListHands(before), hands_after = ListHands(after);
  const bool is_any_hand = hands_before.size() == 1 && hands_after.size() == 1;
  const bool is_any_grasp = HasOneGraspEach(before) && HasOneGraspEach(after);
  const auto make_key = [&](const PlannedTrial& planned) {
    return PairKey(is_any_hand ? "" : planned.hand, planned.object,
                   is_any_grasp ? "" : planned.grasp, planned.trial,
                   planned.condition.value_or(""));
  };
  std::map<PairKey, const TrialRecord*> others;
  for (const TrialRecord& record : after.records) others[make_key(record.plan)] = &record;

  SessionComparison comparison;
  VariedTrials measures;
  for (const TrialRecord& record : before.records) {
    const auto other = others.find(make_key(record.plan));
    if (other == others.end() || !IsSameDraw(before, after, record.plan)) {
      ++comparison.num_only_before;
      continue;
    }
    comparison.pairs.push_back({&record, other->second});
    measures[record.plan.id] = MakeTrialMeasures(other->second->result);
  }
  if (comparison.pairs.empty()) {
    throw Error(ErrorKind::kUsage, "no trial of the two sessions was run on the same draw: " +
                                       ExplainNoPair(before, after));
  }
  comparison.num_only_after =
      static_cast<int>(after.records.size()) - static_cast<int>(comparison.pairs.size());
  comparison.changes = ListChanges(before, "comparison", measures);
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

std::vector<CsvColumn<ThresholdChange>> ListThresholdChangeColumns() {
  using Row = ThresholdChange;
  using C = CsvColumn<Row>;
  return {
      C("scale", "", "", [](const Row& row) { return row.scale->name; }).Shown("grip threshold"),
      C("hand", "", "", &Row::hand).Shown("hand"),
      C("pairs", "", "", &Row::num_pairs).Shown("pairs"),
      C("lower", "", "", &Row::num_lower).Shown("lower"),
      C("equal", "", "", &Row::num_equal).Shown("equal"),
      C("higher", "", "", &Row::num_higher).Shown("higher"),
      C("ratio", "", "", &Row::ratio)
          .Shown("second over first",
                 [](const Row& row) { return FormatWithRange(row.ratio, row.low, row.high, 2); }),
      {"ratio_low", "", "", &Row::low},
      {"ratio_high", "", "", &Row::high}};
}

}  // namespace graspbench
