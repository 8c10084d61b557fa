#include "human_study/events/hold.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace graspbench {
namespace {

using Column = Eigen::Index;
using Eigen::VectorXd;

/** Straight across gaps, level beyond the first and the last value; NaN without any. */
VectorXd BridgeGaps(const VectorXd& values) {
  VectorXd bridged = values;
  Column last = -1;
  for (Column i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    for (Column k = last + 1; k < i; ++k) {
      const double share = static_cast<double>(k - last) / static_cast<double>(i - last);
      bridged[k] = last < 0 ? values[i] : (1.0 - share) * values[last] + share * values[i];
    }
    last = i;
  }
  if (last >= 0) bridged.tail(values.size() - 1 - last).setConstant(values[last]);
  return bridged;
}

/** 1 at the smallest value, 0 at the largest; 1 throughout when they are the same. */
VectorXd CalcSmallness(const VectorXd& values) {
  const double largest = values.maxCoeff(), range = largest - values.minCoeff();
  if (!(range > 0.0)) return VectorXd::Ones(values.size());
  return (largest - values.array()) / range;
}

/** Samples at which the speed of any tip is known. */
std::vector<bool> FindSeen(const std::vector<TipAgainstObject>& tips) {
  std::vector<bool> is_seen(tips[0].speed.size());
  for (size_t i = 0; i < is_seen.size(); ++i) {
    is_seen[i] = std::any_of(tips.begin(), tips.end(),
                             [i](const TipAgainstObject& tip) { return tip.speed.IsValid(i); });
  }
  return is_seen;
}

/** Of the fastest visible tip. */
VectorXd CalcSlowness(const std::vector<TipAgainstObject>& tips, const std::vector<bool>& is_seen,
                      double speed_threshold) {
  VectorXd slow(static_cast<Column>(is_seen.size()));
  for (size_t i = 0; i < is_seen.size(); ++i) slow[static_cast<Column>(i)] = is_seen[i] ? 1.0 : 0.0;
  for (const TipAgainstObject& tip : tips) {
    const double threshold = std::max(speed_threshold, 4.0 * tip.speed.noise);
    for (size_t i = 0; i < is_seen.size(); ++i) {
      if (!tip.speed.IsValid(i)) continue;
      const auto column = static_cast<Column>(i);
      slow[column] =
          std::min(slow[column], std::max(0.0, 1.0 - tip.speed.values[column] / threshold));
    }
  }
  return slow;
}

/** Hidden tips may have rested. */
std::string DescribeNoRest(const HoldCriteria& criteria, const std::vector<bool>& is_seen) {
  constexpr double kWorthTelling = 0.1;  // [s]
  double longest = 0.0, since = std::nan("");
  for (size_t i = 0; i < is_seen.size(); ++i) {
    if (is_seen[i] || criteria.there[static_cast<Column>(i)] == 0.0) {
      since = std::nan("");
    } else {
      if (std::isnan(since)) since = criteria.times[i];
      longest = std::max(longest, criteria.times[i] - since);
    }
  }
  return longest < kWorthTelling
             ? "near the object the tips never rest together"
             : "near the object all tips are hidden for a while and never rest together before or "
               "after it";
}

/** Minus the way from the first place when the object was not recorded; NaN where hidden. */
VectorXd CalcDistance(const ReachTrial& trial, const Trajectory& transport) {
  VectorXd distance(static_cast<Column>(transport.size()));
  Eigen::Vector3d first = Eigen::Vector3d::Constant(std::nan(""));
  for (size_t i = 0; i < transport.size(); ++i) {
    const auto column = static_cast<Column>(i);
    const Eigen::Vector3d p = transport.p.col(column);
    if (first.hasNaN()) first = p;
    distance[column] = trial.object.IsRecorded() ? (p - trial.object.X_LO[i].translation()).norm()
                                                 : -(p - first).norm();
  }
  return distance;
}

/** Of all stretches with a positive product the one with the most of it; its centre of mass. */
int FindLargestProduct(const HoldCriteria& criteria) {
  const VectorXd product = criteria.slow.array() * criteria.there.array() * criteria.closed.array();
  double most = 0.0, sum = 0.0, moment = 0.0;
  int at = -1;
  for (Column i = 0; i < product.size(); ++i) {
    if (!(product[i] > 0.0)) {
      sum = moment = 0.0;
      continue;
    }
    sum += product[i];
    moment += product[i] * static_cast<double>(i);
    if (sum > most) {
      most = sum;
      at = static_cast<int>(std::lround(moment / sum));
    }
  }
  return at;
}

int FindLongestRest(const HoldCriteria& criteria) {
  SampleRun longest, run;
  for (size_t i = 0; i < criteria.times.size(); ++i) {
    const auto column = static_cast<Column>(i);
    if (criteria.slow[column] == 0.0 || criteria.there[column] == 0.0) {
      run = {i + 1, i + 1};
    } else {
      run.last = i + 1;
      if (run.size() > longest.size()) longest = run;
    }
  }
  return longest.size() == 0 ? -1 : static_cast<int>((longest.first + longest.last) / 2);
}

}  // namespace

Hold MakeLiftedHold(double lift_off) { return {lift_off, lift_off - 0.1, lift_off + 0.5, ""}; }

const std::vector<HoldRule>& HoldRuleList() {
  static const std::vector<HoldRule> rules = {
      {"multiplied",
       "centre of the stretch with the most of the product of three criteria between 0 and 1: all "
       "visible tips slow, hand at the object, hand closed (after Schot, Brenner and Smeets 2010)",
       FindLargestProduct},
      {"longest_rest",
       "middle of the longest stretch, in the half of the way nearer to the object, in which all "
       "visible tips are slow",
       FindLongestRest},
  };
  return rules;
}

const HoldRule& FindHoldRule(const std::string& id) {
  std::vector<std::string> known;
  for (const HoldRule& rule : HoldRuleList()) {
    if (rule.id == id) return rule;
    known.push_back(rule.id);
  }
  throw Error(ErrorKind::kNotFound, "no hold rule \"" + id + "\"" + SuggestNames(id, known));
}

Hold FindHold(FilteredTrial& trial, const Trajectory& transport, const ScalarCurve& opening,
              const HoldOptions& options, double object_cutoff) {
  const HoldRule& rule = FindHoldRule(options.rule);
  const VectorXd distance = BridgeGaps(CalcDistance(trial.trial(), transport));
  const VectorXd width = BridgeGaps(opening.values);
  Hold hold;
  if (distance.hasNaN() || width.hasNaN()) {
    hold.missing = "the digits are never seen together";
    return hold;
  }
  HoldCriteria criteria;
  criteria.times = trial.trial().times;
  const std::vector<TipAgainstObject>& tips =
      trial.FilterTipsAgainstObject(options.cutoff, object_cutoff);
  const std::vector<bool> is_seen = FindSeen(tips);
  criteria.slow = CalcSlowness(tips, is_seen, options.speed_threshold);
  criteria.there = (2.0 * CalcSmallness(distance).array() - 1.0).max(0.0);
  criteria.closed = CalcSmallness(width);
  const int at = rule.find(criteria);
  if (at < 0) {
    hold.missing = DescribeNoRest(criteria, is_seen);
    return hold;
  }
  auto first = static_cast<Column>(at), last = first;
  while (first > 0 && criteria.slow[first - 1] > 0.0) --first;
  while (last + 1 < criteria.slow.size() && criteria.slow[last + 1] > 0.0) ++last;
  hold.time = criteria.times[static_cast<size_t>(at)];
  hold.begin = criteria.times[static_cast<size_t>(first)];
  hold.end = criteria.times[static_cast<size_t>(last)];
  return hold;
}

}  // namespace graspbench
