#include "human_study/events/lift_off.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

using Column = Eigen::Index;

constexpr double kRestShare = 0.1;  // of the trial, at its start

ScalarCurve CalcRate(const ScalarCurve& curve) {
  ScalarCurve rate = curve;
  rate.noise = curve.rate_noise;
  for (size_t i = 0; i < curve.size(); ++i) {
    const size_t before = i > 0 ? i - 1 : i, after = i + 1 < curve.size() ? i + 1 : i;
    rate.states[i] =
        CombineStates(curve.states[i], CombineStates(curve.states[before], curve.states[after]));
    rate.values[static_cast<Column>(i)] =
        (curve.values[static_cast<Column>(after)] - curve.values[static_cast<Column>(before)]) /
        (curve.times[after] - curve.times[before]);
  }
  return rate;
}

EventTime FindRise(const ScalarCurve& height, const LiftOffOptions& options) {
  const int top = FindFirstAbove(height, options.min_rise);
  if (top < 0) return MissingEvent("the object does not rise far enough");
  return TraceBack(height, static_cast<size_t>(top), 0, options.rise, Side::kAbove);
}

EventTime FindTracedBack(const ScalarCurve& height, const LiftOffOptions& options) {
  const int top = FindPeak(height, {0, height.size()});
  if (top < 0 || height.values[top] < options.min_rise) {
    return MissingEvent("the object does not rise far enough");
  }
  const int half = FindFirstAbove(height, height.values[top] / 2);
  return TraceBack(CalcRate(height), static_cast<size_t>(half), 0, options.speed, Side::kAbove);
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

}  // namespace

const std::vector<LiftOffRule>& LiftOffRuleList() {
  static const std::vector<LiftOffRule> rules = {
      {"traced_back",
       "vertical speed of the object, traced back from half its height to the threshold "
       "(after Luciw et al. 2014)",
       FindTracedBack},
      {"rise", "the object has risen by a fixed height", FindRise},
  };
  return rules;
}

ObjectTravel CalcObjectTravel(const ReachTrial& trial, const LiftOffOptions& options) {
  Trajectory origin;  // the middle of the markers: no turn moves it
  origin.times = trial.times;
  origin.states = trial.object.states;
  origin.p.resize(3, static_cast<Column>(trial.times.size()));
  for (size_t i = 0; i < trial.times.size(); ++i) {
    origin.p.col(static_cast<Column>(i)) = trial.object.X_LO[i] * trial.object.p_OC;
  }
  const SmoothPath smooth = Smooth(origin, options.cutoff);
  const Eigen::Vector3d place = FindRestingPlace(smooth.path);
  const Eigen::Vector3d up = Eigen::Vector3d(options.up_x, options.up_y, options.up_z).normalized();

  ObjectTravel travel;
  for (ScalarCurve* curve : {&travel.height, &travel.displacement}) {
    curve->times = trial.times;
    curve->states = origin.states;
    curve->values.resize(static_cast<Column>(trial.times.size()));
    curve->noise = smooth.smooth_noise;
    curve->rate_noise = smooth.speed_noise;
    curve->reach = smooth.reach;
  }
  travel.moved.resize(3, origin.p.cols());
  for (Column i = 0; i < origin.p.cols(); ++i) {
    const Eigen::Vector3d moved = smooth.path.p.col(i) - place;
    travel.moved.col(i) = moved;
    travel.height.values[i] = up.dot(moved);
    travel.displacement.values[i] = moved.norm();
  }
  return travel;
}

ObjectEvents FindObjectEvents(const ObjectTravel& travel, const LiftOffOptions& options) {
  const std::vector<LiftOffRule>& rules = LiftOffRuleList();
  const auto rule = std::find_if(rules.begin(), rules.end(),
                                 [&](const LiftOffRule& r) { return r.id == options.rule; });
  GRASPBENCH_DEMAND(rule != rules.end(), options.rule);
  ObjectEvents events;
  events.lift_off = rule->find(travel.height, options);
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

}  // namespace graspbench
