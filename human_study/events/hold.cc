#include "human_study/events/hold.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/statistics/summary.h"
#include "human_study/events/approach.h"
#include "human_study/events/lift_off_fit.h"

namespace graspbench {

namespace {

using Column = Eigen::Index;

constexpr double kRestShare = 0.1;    // of the trial, at its start
constexpr double kLeastNoise = 1e-5;  // no marker is known better than this [m]

ScalarCurve CalcRate(const ScalarCurve& curve) {
  ScalarCurve rate = curve;
  rate.noise = curve.rate_noise;
  for (size_t i = 0; i < curve.size(); ++i) {
    const size_t before = i > 0 ? i - 1 : i, after = i + 1 < curve.size() ? i + 1 : i;
    rate.states[i] =
        CombineStates(curve.states[i], CombineStates(curve.states[before], curve.states[after]));
    rate.At(i) = (curve.At(after) - curve.At(before)) / (curve.times[after] - curve.times[before]);
  }
  return rate;
}

EventTime FindRise(const ObjectTravel& travel, const LiftOffOptions& options) {
  const ScalarCurve& height = travel.height;
  const int top = FindFirstAbove(height, options.min_rise);
  if (top < 0) return MissingEvent("the object does not rise far enough");
  return TraceBack(height, static_cast<size_t>(top), 0, options.rise, Side::kAbove);
}

EventTime FindTracedBack(const ObjectTravel& travel, const LiftOffOptions& options) {
  const ScalarCurve& height = travel.height;
  const int top = FindPeak(height, {0, height.size()});
  if (top < 0 || height.values[top] < options.min_rise) {
    return MissingEvent("the object does not rise far enough");
  }
  const int half = FindFirstAbove(height, height.values[top] / 2);
  return TraceBack(CalcRate(height), static_cast<size_t>(half), 0, options.speed, Side::kAbove);
}

EventTime FindFitted(const ObjectTravel& travel, const LiftOffOptions& options) {
  const EventTime traced = FindTracedBack(travel, options);
  if (!traced.IsFound()) return traced;
  const EventTime fitted = FitLiftOff(travel.lowest, traced.time);
  return fitted.IsFound() ? fitted : traced;
}

/** Median of each coordinate over the start of the path; NaN when nothing is seen there. */
Eigen::Vector3d FindRestingPlace(const Trajectory& path) {
  const size_t count =
      std::max<size_t>(1, static_cast<size_t>(kRestShare * static_cast<double>(path.size())));
  Eigen::Vector3d place;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (size_t i = 0; i < count; ++i) {
      if (path.IsValid(i)) values.push_back(path.p(axis, static_cast<Column>(i)));
    }
    place[axis] = CalcMedian(std::move(values));
  }
  return place;
}

/** On what the object can stand at rest: its lowest point, and the edge of what lies within 0.3 mm
of that. From C, in O. @pre the shape is known. */
std::vector<Eigen::Vector3d> FindStandingEdge(const ObjectTrack& object,
                                              const Eigen::Vector3d& up_O) {
  constexpr double kStep = 0.5e-3, kMostSteps = 600, kLevel = 0.3e-3;  // [m]
  constexpr int kNumDirections = 24;
  const auto go = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
    Eigen::Vector3d p = from;
    for (int i = 0; i < kMostSteps && object.distance(p) < 0.0; ++i) p += kStep * direction;
    return p;
  };
  Eigen::Vector3d inside = object.p_OC;
  for (int i = 0; i < 8 && object.distance(inside) >= 0.0; ++i) {
    inside -= (object.distance(inside) + kStep) * FindNormal(object.distance, inside);
  }
  const Eigen::Vector3d lowest = go(inside, -up_O);
  std::vector<Eigen::Vector3d> edge = {lowest - object.p_OC};
  const Eigen::Vector3d level = lowest + (kLevel + kStep) * up_O;
  const Eigen::Vector3d across = up_O.unitOrthogonal(), other = up_O.cross(across);
  for (int k = 0; k < kNumDirections; ++k) {
    const double angle = 2.0 * kPi * k / kNumDirections;
    const Eigen::Vector3d end = go(level, std::cos(angle) * across + std::sin(angle) * other);
    edge.push_back(end - (end - lowest).dot(up_O) * up_O - object.p_OC);
  }
  return edge;
}

/** Height of the lowest of the points that the object stands on, less that at rest. Its turn is
filtered and as far as it exceeds the noise of the markers, so that it adds little noise. */
ScalarCurve FollowLowest(const ReachTrial& trial, const ScalarCurve& middle,
                         const Eigen::Vector3d& up, double cutoff) {
  if (!trial.object.distance || trial.object.turn_lever.isZero()) return middle;
  const double interval = trial.times[1] - trial.times[0];
  const double of_turn = std::max(cutoff, std::min(2.0 * cutoff, 0.35 / interval));
  const ObjectTrack object = SmoothObject(trial, cutoff, of_turn);
  const Eigen::Matrix3d R_LO = FindRestingOrientation(trial.object);
  const std::vector<Eigen::Vector3d> edge = FindStandingEdge(object, R_LO.transpose() * up);
  const auto find_lowest = [&](const Eigen::Matrix3d& R) {
    double lowest = INFINITY;
    for (const Eigen::Vector3d& p : edge) lowest = std::min(lowest, up.dot(R * p));
    return lowest;
  };
  const double rest = find_lowest(R_LO);
  ScalarCurve curve = middle;
  for (size_t i = 0; i < curve.size(); ++i) {
    curve.At(i) += find_lowest(object.X_LO[i].linear()) - rest;
  }
  return curve;
}

}  // namespace

const std::vector<LiftOffRule>& LiftOffRuleList() {
  static const std::vector<LiftOffRule> rules = {
      {"fitted",
       "where the unfiltered height of the object breaks from rest to rise: mean over all breaks "
       "and four ways to start (with a speed, an acceleration, a jerk, a snap), weighed by how "
       "well they explain the samples",
       FindFitted},
      {"traced_back",
       "vertical speed of the object, traced back from half its height to the threshold "
       "(after Luciw et al. 2014)",
       FindTracedBack},
      {"rise", "the object has risen by a fixed height", FindRise},
  };
  return rules;
}

ObjectTravel CalcObjectTravel(const ReachTrial& trial, const LiftOffOptions& options) {
  const Trajectory origin = TakeObjectPath(trial);
  const SmoothPath smooth = Smooth(origin, options.cutoff);
  const Eigen::Vector3d place = FindRestingPlace(smooth.path);
  const Eigen::Vector3d up = Eigen::Vector3d(options.up_x, options.up_y, options.up_z).normalized();

  ObjectTravel travel;
  for (ScalarCurve* curve : {&travel.height, &travel.displacement, &travel.unfiltered}) {
    curve->times = trial.times;
    curve->states = origin.states;
    curve->values.resize(static_cast<Column>(trial.times.size()));
    curve->noise = smooth.smooth_noise;
    curve->rate_noise = smooth.speed_noise;
    curve->reach = smooth.reach;
  }
  travel.unfiltered.noise = std::max(kLeastNoise, smooth.noise);
  travel.unfiltered.reach = 0.0;
  travel.moved.resize(3, origin.p.cols());
  travel.moved_unfiltered = origin.p.colwise() - place;
  travel.unfiltered.values = travel.moved_unfiltered.transpose() * up;
  for (Column i = 0; i < origin.p.cols(); ++i) {
    const Eigen::Vector3d moved = smooth.path.p.col(i) - place;
    travel.moved.col(i) = moved;
    travel.height.values[i] = up.dot(moved);
    travel.displacement.values[i] = moved.norm();
  }
  travel.lowest = FollowLowest(trial, travel.unfiltered, up, options.cutoff);
  return travel;
}

ObjectEvents FindObjectEvents(const ObjectTravel& travel, const LiftOffOptions& options) {
  const std::vector<LiftOffRule>& rules = LiftOffRuleList();
  const auto rule = std::find_if(rules.begin(), rules.end(),
                                 [&](const LiftOffRule& r) { return r.id == options.rule; });
  GRASPBENCH_DEMAND(rule != rules.end(), options.rule);
  ObjectEvents events;
  events.lift_off = rule->find(travel, options);
  const int moved = FindFirstAbove(travel.displacement, options.displacement);
  events.moved = moved < 0 ? MissingEvent("the object never moves")
                           : TraceBack(travel.displacement, static_cast<size_t>(moved), 0,
                                       options.displacement, Side::kAbove);
  return events;
}

std::vector<ObjectWay> FindWaysBeforeRise(const ObjectTravel& travel, double least,
                                          const LiftOffOptions& options) {
  constexpr double kUnderWay = 10e-3;  // [m]
  constexpr double kBehind = 0.3;      // of the height that would keep pace
  const double height = travel.height.values.maxCoeff<Eigen::PropagateNumbers>();
  std::vector<ObjectWay> ways;
  for (Column i = 0; i < 6; ++i) {
    const Eigen::Vector3d axis = (i % 2 == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(i / 2);
    ObjectTravel other = travel;
    other.height.values = travel.moved.transpose() * axis;
    other.unfiltered.values = travel.moved_unfiltered.transpose() * axis;
    other.lowest = other.unfiltered;
    const double along = other.height.values.maxCoeff<Eigen::PropagateNumbers>();
    if (!(along > least)) continue;
    const int under_way = FindFirstAbove(other.height, kUnderWay);
    if (under_way < 0) continue;
    const double risen = travel.height.values[under_way];
    if (!(risen < kBehind * height / along * other.height.values[under_way])) continue;
    ways.push_back({axis, along, FindObjectEvents(other, options).lift_off});
  }
  return ways;
}

namespace {

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
