#include "datasets/analysis/hand_differences.h"

#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "core/base/text/text.h"
#include "core/statistics/multiple_tests.h"
#include "core/statistics/paired_clusters.h"

namespace graspbench {
namespace {

constexpr double kSignificantP = 0.05;

/** Of the hands with these places among the sides. */
HandDifference CompareSides(const std::vector<ComparedDraw>& draws, size_t hand, size_t other) {
  HandDifference difference;
  std::map<std::string, PairedCounts> objects;
  ObjectChanges changes;
  PairedCounts pairs;
  std::set<const TrialRecord*> records;
  for (const ComparedDraw& draw : draws) {
    difference.num_planned += draw.planned[hand] && draw.planned[other];
    if (!draw.records[hand] || !draw.records[other]) continue;
    const bool is_held = IsSuccess(draw.records[hand]->result.outcome);
    const bool is_held_by_other = IsSuccess(draw.records[other]->result.outcome);
    pairs.Add(is_held_by_other, is_held);
    objects[draw.object].Add(is_held_by_other, is_held);
    changes[draw.object].push_back(double(is_held) - double(is_held_by_other));
    records.insert({draw.records[hand], draw.records[other]});
  }
  difference.change =
      EstimateSuccessChange(changes, pairs, ExplainUndecided(CountOutcomes(records)));
  if (difference.change.interval && objects.size() >= kFewestClusters) {
    std::vector<PairedCounts> counts;
    for (const auto& [object, count] : objects) counts.push_back(count);
    difference.p = CalcClusteredExactTwoSided(counts);
  }
  return difference;
}

}  // namespace

std::vector<HandDifference> CompareHands(const Session& session,
                                         const std::vector<std::string>& hands) {
  if (hands.size() < 2) return {};
  std::vector<ComparedSide> sides;
  for (const std::string& hand : hands) sides.push_back({&session, std::nullopt, hand});
  const std::vector<ComparedDraw> draws = ListComparedDraws(sides, true);
  std::vector<HandDifference> differences;
  std::vector<double> p;
  for (size_t i = 0; i < hands.size(); ++i) {
    for (size_t j = i + 1; j < hands.size(); ++j) {
      HandDifference difference = CompareSides(draws, i, j);
      if (difference.num_planned == 0) continue;
      difference.hand = hands[i];
      difference.other = hands[j];
      p.push_back(difference.p);
      differences.push_back(std::move(difference));
    }
  }
  p = AdjustHolm(p);
  for (size_t i = 0; i < differences.size(); ++i) differences[i].p = p[i];
  return differences;
}

std::string DescribeHandDifference(const HandDifference& difference, const std::string& name,
                                   const std::string& other) {
  const ChangeEstimate& change = difference.change;
  std::string text = name + " minus " + other + ", " +
                     FormatCountOf(change.num_draws, difference.num_planned) +
                     (difference.num_planned == 1 ? " pair of " : " pairs of ") +
                     FormatCount(change.num_objects, "object") + ": ";
  if (!change.interval) return text + change.interval.reason();
  text += FormatFixed(100.0 * change.estimate, 1) + " points (" +
          FormatRange(100.0 * change.interval->low, 100.0 * change.interval->high, 1) + ")";
  if (std::isnan(difference.p)) {
    return text + ", not testable with fewer than " + std::to_string(kFewestClusters) + " objects";
  }
  return text + ", p " + FormatFixed(difference.p, 4) +
         (difference.p < kSignificantP ? ", significant" : ", not significant");
}

Json ToJson(const std::vector<HandDifference>& differences) {
  Json rows = Json::array();
  for (const HandDifference& difference : differences) {
    const ChangeEstimate& change = difference.change;
    rows.push_back(
        {{"hand", difference.hand},
         {"other", difference.other},
         {"pairs", change.num_draws},
         {"planned_pairs", difference.num_planned},
         {"objects", change.num_objects},
         {"rate_difference", JsonNumber(change.estimate)},
         {"rate_difference_low", change.interval ? Json(change.interval->low) : Json(nullptr)},
         {"rate_difference_high", change.interval ? Json(change.interval->high) : Json(nullptr)},
         {"p", JsonNumber(difference.p)}});
  }
  return rows;
}

}  // namespace graspbench
