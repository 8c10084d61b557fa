#include "datasets/analysis/controller_comparison.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/text/text.h"
#include "core/statistics/summary.h"
#include "datasets/analysis/pairs.h"

namespace graspbench {
namespace {

void AddCounts(const PairedCounts& part, PairedCounts& sum) {
  sum.both += part.both;
  sum.first_only += part.first_only;
  sum.second_only += part.second_only;
  sum.neither += part.neither;
}

/** Of all hands. */
ChangeEstimate EstimatePooledChange(const std::vector<TrialPair>& pairs) {
  ObjectChanges changes;
  PairedCounts counts;
  std::set<const TrialRecord*> records;
  for (const TrialPair& pair : pairs) {
    const bool before = IsSuccess(pair.before->result.outcome);
    const bool after = IsSuccess(pair.after->result.outcome);
    counts.Add(before, after);
    changes[pair.before->plan.hand + "\n" + pair.before->plan.object].push_back(double(after) -
                                                                                double(before));
    records.insert({pair.before, pair.after});
  }
  return EstimateSuccessChange(changes, counts, ExplainUndecided(CountOutcomes(records)));
}

std::vector<PairedCounts> ListCounts(const std::vector<ObjectComparison>& objects) {
  std::vector<PairedCounts> counts;
  for (const ObjectComparison& one : objects) counts.push_back(one.successes);
  return counts;
}

std::string FormatShareOf(int count, int num) {
  return FormatWithRange(100.0 * CalcShare(count, num), 100.0 * CalcWilsonInterval(count, num).low,
                         100.0 * CalcWilsonInterval(count, num).high, 0);
}

std::string FormatP(double p) { return std::isnan(p) ? "n/a" : FormatFixed(p, 4); }

}  // namespace

std::vector<ObjectComparison> CompareObjects(const std::vector<TrialPair>& pairs) {
  std::vector<ObjectComparison> objects;
  for (const TrialPair& pair : pairs) {
    const PlannedTrial& plan = pair.before->plan;
    auto found = std::find_if(objects.begin(), objects.end(), [&](const ObjectComparison& one) {
      return one.hand == plan.hand && one.object == plan.object;
    });
    if (found == objects.end()) {
      objects.push_back({plan.hand, plan.object, {}});
      found = objects.end() - 1;
    }
    found->successes.Add(IsSuccess(pair.before->result.outcome),
                         IsSuccess(pair.after->result.outcome));
  }
  return objects;
}

std::vector<HandDecision> DecideByObject(const std::vector<ObjectComparison>& objects) {
  std::vector<HandDecision> decisions;
  for (const ObjectComparison& one : objects) {
    const bool is_new = std::none_of(decisions.begin(), decisions.end(),
                                     [&](const HandDecision& d) { return d.hand == one.hand; });
    if (!is_new) continue;
    HandDecision decision;
    decision.hand = one.hand;
    std::vector<PairedCounts> counts;
    for (const ObjectComparison& other : objects) {
      if (other.hand != one.hand) continue;
      counts.push_back(other.successes);
      AddCounts(other.successes, decision.successes);
    }
    decision.num_objects = static_cast<int>(counts.size());
    decision.p = CalcClusteredExactTwoSided(counts);
    decision.num_pairs_needed = CalcPairsNeeded(EstimatePairedPlan(counts, kPlannedDifference));
    decisions.push_back(decision);
  }
  return decisions;
}

std::vector<LoadChange> CompareLoads(const std::vector<TrialPair>& pairs) {
  struct Loads {
    std::string hand;
    int num_left_out = 0;
    std::vector<double> before, after, ratios;
  };
  std::vector<Loads> hands;
  for (const TrialPair& pair : pairs) {
    const auto find_force = [](const TrialRecord& record) {
      return record.judgement ? record.judgement->breaking_force : kUnset;
    };
    const double before = find_force(*pair.before), after = find_force(*pair.after);
    const std::string& hand = pair.before->plan.hand;
    auto found = std::find_if(hands.begin(), hands.end(),
                              [&](const Loads& loads) { return loads.hand == hand; });
    if (found == hands.end()) {
      hands.emplace_back().hand = hand;
      found = hands.end() - 1;
    }
    if (!(before > 0.0) || !(after > 0.0)) {
      ++found->num_left_out;
      continue;
    }
    found->before.push_back(before);
    found->after.push_back(after);
    found->ratios.push_back(after / before);
  }
  std::vector<LoadChange> changes;
  for (const Loads& loads : hands) {
    if (loads.ratios.empty()) continue;
    LoadChange change;
    change.num_left_out = loads.num_left_out;
    change.hand = loads.hand;
    change.num_pairs = static_cast<int>(loads.ratios.size());
    change.before = CalcMedian(loads.before);
    change.after = CalcMedian(loads.after);
    change.ratio = CalcMedian(loads.ratios);
    if (const auto interval = CalcMedianInterval(loads.ratios)) {
      change.low = interval->low;
      change.high = interval->high;
    }
    changes.push_back(change);
  }
  return changes;
}

std::vector<LearningPoint> ListLearningPoints(
    const std::vector<std::pair<std::string, const Session*>>& sessions) {
  std::vector<LearningPoint> points;
  for (const auto& [name, session] : sessions) {
    LearningPoint point;
    point.name = name;
    point.command = session->config.policy.command;
    for (const TrialRecord& record : session->records) {
      ++point.num_trials;
      point.num_successes += IsSuccess(record.result.outcome);
    }
    point.rate = CalcShare(point.num_successes, point.num_trials);
    point.interval = CalcWilsonInterval(point.num_successes, point.num_trials);
    if (session != sessions.front().second) {
      try {
        const std::vector<TrialPair> pairs =
            CompareSessions(*sessions.front().second, *session).pairs;
        const auto objects = CompareObjects(pairs);
        const ChangeEstimate change = EstimatePooledChange(pairs);
        point.num_pairs = change.num_draws;
        point.change = change.estimate;
        if (change.interval) {
          point.change_low = change.interval->low;
          point.change_high = change.interval->high;
        }
        point.p = CalcClusteredExactTwoSided(ListCounts(objects));
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::kUsage) throw;  // else no draw in common
      }
    }
    points.push_back(std::move(point));
  }
  return points;
}

std::vector<CsvColumn<ObjectComparison>> ListObjectComparisonColumns() {
  using Row = ObjectComparison;
  using C = CsvColumn<Row>;
  const auto failed_first = [](const Row& row) {
    return row.successes.second_only + row.successes.neither;
  };
  const auto failed_second = [](const Row& row) {
    return row.successes.first_only + row.successes.neither;
  };
  return {
      C("hand", "", "of the first session", &Row::hand).Shown("hand"),
      C("object", "", "", &Row::object).Shown("object"),
      C("pairs", "", "of the same draw",
        [](const Row& row) {
          return row.successes.num_pairs();
        }).Shown("pairs"),
      C("failed_first", "", "failures of the first session", failed_first).Shown("first fails"),
      C("failed_second", "", "failures of the second session", failed_second).Shown("second fails"),
      C("failed_both", "", "draws that fail in both sessions",
        [](const Row& row) {
          return row.successes.neither;
        }).Shown("both fail"),
      CsvColumn<Row>::ForPeople(
          "both fail [%]", "share that fails in both, with its 95 % interval", [](const Row& row) {
            return FormatShareOf(row.successes.neither, row.successes.num_pairs());
          })};
}

std::vector<CsvColumn<HandDecision>> ListHandDecisionColumns() {
  using Row = HandDecision;
  using C = CsvColumn<Row>;
  return {C("hand", "", "of the first session", &Row::hand).Shown("hand"),
          C("objects", "", "with pairs", &Row::num_objects).Shown("objects"),
          C("p", "", "equal success rates: exact test clustered by object", &Row::p)
              .Shown("p", [](const Row& row) { return FormatP(row.p); }),
          C("differing", "", "share of pairs in which one of the two succeeds",
            [](const Row& row) {
              return CalcShare(row.successes.first_only + row.successes.second_only,
                               row.successes.num_pairs());
            })
              .Shown("differing",
                     [](const Row& row) {
                       return FormatPercent(
                           CalcShare(row.successes.first_only + row.successes.second_only,
                                     row.successes.num_pairs()));
                     }),
          C("pairs_for_10_points", "",
            "pairs on these objects that decide 10 points in 80 % of comparisons; missing: more "
            "pairs on these objects do not",
            [](const Row& row) {
              return row.num_pairs_needed ? static_cast<double>(*row.num_pairs_needed) : kUnset;
            }).Shown("pairs for 10 points", [](const Row& row) {
            return row.num_pairs_needed ? std::to_string(*row.num_pairs_needed)
                                        : std::string("more objects");
          })};
}

std::vector<CsvColumn<LoadChange>> ListLoadChangeColumns() {
  using Row = LoadChange;
  using C = CsvColumn<Row>;
  return {
      C("hand", "", "of the first session", &Row::hand).Shown("hand"),
      C("pairs", "", "judged in both", &Row::num_pairs)
          .Shown("judged pairs",
                 [](const Row& row) {
                   return FormatCountOf(row.num_pairs, row.num_pairs + row.num_left_out);
                 }),
      C("before_n", "N", "median breaking force of the first session", &Row::before)
          .Shown("first [N]", [](const Row& row) { return FormatFixed(row.before, 2); }),
      C("after_n", "N", "median breaking force of the second session", &Row::after)
          .Shown("second [N]", [](const Row& row) { return FormatFixed(row.after, 2); }),
      C("ratio", "", "median over pairs of the ratio second to first", &Row::ratio)
          .Shown("second over first",
                 [](const Row& row) { return FormatWithRange(row.ratio, row.low, row.high, 2); }),
      {"ratio_low", "", "95 % interval of ratio, lower end", &Row::low},
      {"ratio_high", "", "95 % interval of ratio, upper end", &Row::high},
      {"left_out", "", "pairs not judged in both sessions, or without a breaking force",
       &Row::num_left_out}};
}

std::vector<CsvColumn<LearningPoint>> ListLearningColumns() {
  using Row = LearningPoint;
  using C = CsvColumn<Row>;
  return {
      C("session", "", "name of its folder", &Row::name).Shown("session"),
      C("trials", "", "finished", &Row::num_trials).Shown("trials"),
      C("successes", "", "", &Row::num_successes).Shown("successes"),
      C("rate", "", "share of successes", &Row::rate)
          .Shown("success [%]",
                 [](const Row& row) {
                   return FormatWithRange(100.0 * row.rate, 100.0 * row.interval.low,
                                          100.0 * row.interval.high, 1);
                 }),
      {"rate_low", "", "95 % interval of rate, lower end",
       [](const Row& row) { return row.interval.low; }},
      {"rate_high", "", "95 % interval of rate, upper end",
       [](const Row& row) { return row.interval.high; }},
      C("pairs", "", "with the first session, on the same draws", &Row::num_pairs).Shown("pairs"),
      C("change", "", "of the rate against the first session, over the pairs", &Row::change)
          .Shown("against the first [%]",
                 [](const Row& row) {
                   return row.num_pairs == 0
                              ? std::string()
                              : FormatWithRange(100.0 * row.change, 100.0 * row.change_low,
                                                100.0 * row.change_high, 1);
                 }),
      {"change_low", "", "95 % interval of change, lower end", &Row::change_low},
      {"change_high", "", "95 % interval of change, upper end", &Row::change_high},
      C("p", "", "equal success rates: exact test clustered by hand and object", &Row::p)
          .Shown("p", [](const Row& row) { return row.num_pairs == 0 ? "" : FormatP(row.p); }),
      C("policy", "", "policy.command; empty: the strategy", &Row::command).Shown("policy")};
}

}  // namespace graspbench
