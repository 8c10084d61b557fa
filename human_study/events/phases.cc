#include "human_study/events/phases.h"

#include <algorithm>
#include <cmath>

namespace graspbench {
namespace {

using Column = Eigen::Index;

constexpr double kProminence = 0.1;  // of the largest deceleration
constexpr double kNoiseSigmas = 4.0;

MovementPhases NoPhases(const char* why) {
  MovementPhases phases;
  phases.reacceleration = MissingEvent(why);
  return phases;
}

/** By central differences; NaN beside what is not valid [m/s^2]. */
Eigen::VectorXd CalcAcceleration(const ScalarCurve& speed) {
  const auto size = static_cast<Column>(speed.size());
  Eigen::VectorXd a = Eigen::VectorXd::Constant(size, std::nan(""));
  for (Column i = 1; i + 1 < size; ++i) {
    a[i] = (speed.values[i + 1] - speed.values[i - 1]) / (2.0 * speed.Interval());
  }
  return a;
}

/** Where the parabola through a sample and its neighbours has its top, in samples from it. */
double FindTop(const Eigen::VectorXd& a, Column i) {
  const double bend = a[i - 1] - 2.0 * a[i] + a[i + 1];
  return bend < 0.0 ? std::clamp((a[i - 1] - a[i + 1]) / (2.0 * bend), -0.5, 0.5) : 0.0;
}

}  // namespace

MovementPhases FindPhases(const ScalarCurve& speed, const Movement& movement) {
  if (!movement.onset.IsFound() || !movement.end.IsFound()) {
    return NoPhases("the movement has no onset or no end");
  }
  const SampleRun run = FindSamples(speed.times, movement.peak_time, movement.end.time);
  if (run.size() < 5) return NoPhases("too few samples between the peak of speed and the end");
  const Eigen::VectorXd a = CalcAcceleration(speed);
  const auto first = static_cast<Column>(run.first), last = static_cast<Column>(run.last);
  Column lowest = first;
  for (Column i = first; i < last; ++i) {
    if (std::isnan(a[i])) return NoPhases("the wrist is hidden while it slows down");
    if (a[i] < a[lowest]) lowest = i;
  }
  const double noise =
      speed.reach > 0.0 ? speed.noise / speed.reach : 0.0;  // of a, behind a filter
  const double prominence = std::max(-kProminence * a[lowest], kNoiseSigmas * noise);
  Column highest = lowest;
  bool falls = false;
  for (Column i = lowest; i < last && !falls; ++i) {
    if (a[i] > a[highest]) highest = i;
    falls = a[highest] - a[lowest] > prominence && a[i] < a[highest] - prominence;
  }
  if (!falls) return NoPhases("the hand slows down once, without a second phase");

  MovementPhases phases;
  EventTime& event = phases.reacceleration;
  const double interval = speed.Interval();
  phases.rises = a[highest] > 0.0;
  double slope = 0.0;  // how fast what decides changes there, per second
  if (phases.rises) {
    Column i = highest;
    while (i > lowest && a[i - 1] > 0.0) --i;  // a[i - 1] <= 0 < a[i]
    slope = (a[i] - a[i - 1]) / interval;
    event.time = speed.times[static_cast<size_t>(i)] - a[i] / slope;
  } else {
    const double bend = (a[highest - 1] - 2.0 * a[highest] + a[highest + 1]) / interval;
    event.time = speed.times[static_cast<size_t>(highest)] + FindTop(a, highest) * interval;
    slope = std::abs(bend) / std::max(speed.reach, interval) * interval;
  }
  event.uncertainty = std::hypot(interval / std::sqrt(12.0), slope > 0.0 ? noise / slope : 0.0);
  event.is_filled = HasFilledNear(speed, event.time);
  return phases;
}

}  // namespace graspbench
