#include "human_study/events/movement.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace graspbench {

namespace {

using Column = Eigen::Index;

EventTime FindThreshold(const ScalarCurve& speed, size_t peak, const MovementOptions& options) {
  return TraceBack(speed, peak, 0, options.speed_threshold, Side::kAbove);
}

EventTime FindPeakFraction(const ScalarCurve& speed, size_t peak, const MovementOptions& options) {
  const double threshold = options.peak_fraction * speed.At(peak);
  return TraceBack(speed, peak, 0, threshold, Side::kAbove);
}

EventTime FindLongestRun(const ScalarCurve& speed, size_t, const MovementOptions& options) {
  SampleRun longest, run;
  for (size_t i = 0; i < speed.size(); ++i) {
    const bool is_fast = speed.IsValid(i) && speed.At(i) > options.speed_threshold;
    if (!is_fast) {
      run = {i + 1, i + 1};
    } else {
      run.last = i + 1;
      if (run.size() > longest.size()) longest = run;
    }
  }
  if (longest.size() == 0) return MissingEvent("the speed never exceeds the threshold");
  return TraceBack(speed, longest.first, 0, options.speed_threshold, Side::kAbove);
}

EventTime FindBaseline(const ScalarCurve& speed, size_t peak, const MovementOptions& options) {
  constexpr double kDistance = 0.1;  // [s] the quiet window keeps from the coarse onset
  constexpr double kLength = 0.5;    // [s]
  constexpr double kNumSds = 2.0;
  const EventTime coarse = FindThreshold(speed, peak, options);
  if (!coarse.IsFound()) return coarse;
  const SampleRun window =
      FindSamples(speed.times, coarse.time - kDistance - kLength, coarse.time - kDistance);
  double sum = 0.0, square_sum = 0.0, count = 0.0;
  for (size_t i = window.first; i < window.last; ++i) {
    if (!speed.IsValid(i)) continue;
    const double value = speed.At(i);
    sum += value;
    square_sum += value * value;
    count += 1.0;
  }
  if (count < 5.0) return MissingEvent("no quiet samples 0.1 s before the movement");
  const double mean = sum / count;
  const double variance = std::max(0.0, square_sum / count - mean * mean) * count / (count - 1.0);
  return TraceBack(speed, peak, 0, mean + kNumSds * std::sqrt(variance), Side::kAbove);
}

EventTime FindRegression(const ScalarCurve& speed, size_t peak, const MovementOptions&) {
  const double top = speed.At(peak);
  // The rising flank from 10 to 60 % of the peak.
  size_t last = peak;
  while (last > 0 && !(speed.At(last) <= 0.6 * top)) --last;
  size_t first = last;
  while (first > 0 && !(speed.At(first) <= 0.1 * top)) --first;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double count = 0.0, square_sum = 0.0;
  const double origin = speed.times[last];
  bool is_filled = false;
  for (size_t i = first; i <= last; ++i) {
    if (!speed.IsValid(i)) continue;
    const double t = speed.times[i] - origin;
    const double y = std::sqrt(speed.At(i));
    const Eigen::Vector3d row(1.0, t, t * t);
    normal += row * row.transpose();
    right += row * y;
    square_sum += y * y;
    count += 1.0;
    is_filled |= speed.states[i] == SampleState::kFilled;
  }
  if (count < 5.0) return MissingEvent("fewer than five samples on the rising flank");
  const Eigen::Matrix3d inverse = normal.inverse();
  const Eigen::Vector3d c = inverse * right;
  // The root on the way up is where the parabola has a positive slope. A hand that turns without
  // stopping has none: it turns where the parabola, open above, is lowest.
  const double discriminant = c[1] * c[1] - 4.0 * c[2] * c[0];
  const bool is_turn = !(discriminant > 0.0);
  const double slope = is_turn ? 2.0 * c[2] : std::sqrt(discriminant);
  double at = -c[1] / slope;
  if (!is_turn) at = c[2] != 0.0 ? (slope - c[1]) / (2.0 * c[2]) : -c[0] / c[1];
  // How the instant follows the coefficients, but for the sign.
  const Eigen::Vector3d change =
      (is_turn ? Eigen::Vector3d(0.0, 1.0, 2.0 * at) : Eigen::Vector3d(1.0, at, at * at)) / slope;
  const double residual = std::max(0.0, square_sum - c.dot(right)) / (count - 3.0);
  EventTime event;
  event.time = origin + at;
  event.uncertainty = std::hypot(std::sqrt(residual * change.dot(inverse * change)),
                                 speed.Interval() / std::sqrt(12.0));
  event.is_filled = is_filled;
  const double latest = is_turn ? origin : speed.times[first] + speed.Interval();
  if (!(event.time <= latest)) return MissingEvent("the rising flank does not lead to zero");
  return event;
}

EventTime FindMultiplied(const ScalarCurve& speed, size_t peak, const MovementOptions&) {
  const double top = speed.At(peak);
  const double begin = speed.times[0], length = speed.times[peak] - begin;
  ScalarCurve product = Cut(speed, {0, peak + 1});
  for (size_t i = 0; i <= peak; ++i) {
    const double is_slow = 1.0 - speed.At(i) / top;
    const double is_late = (speed.times[i] - begin) / length;
    product.At(i) = is_slow * is_late;
  }
  return FindProductPeak(product);
}

struct FlankFit {
  double start = std::nan("");     // [s], counted from the first sample of the flank
  double variance = std::nan("");  // of the start, for residuals of SD one
  double squares = 0.0;            // of what it leaves of the speed
};

/** The n-th root of speed as a parabola; its root on the way up. */
FlankFit FitFlank(const ScalarCurve& speed, size_t first, size_t last, double exponent) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const auto at = [&](size_t i) { return speed.times[i] - speed.times[first]; };
  const auto value = [&](size_t i) { return speed.At(i); };
  for (size_t i = first; i <= last; ++i) {
    if (!speed.IsValid(i) || !(value(i) > 0.0)) continue;
    const double y = std::pow(value(i), 1.0 / exponent);
    // An error of the speed is one of the root by this much, so that all samples weigh alike.
    const double weight = exponent * value(i) / y;
    const Eigen::Vector3d row = weight * Eigen::Vector3d(1.0, at(i), at(i) * at(i));
    normal += row * row.transpose();
    right += row * weight * y;
  }
  const Eigen::Matrix3d inverse = normal.inverse();
  const Eigen::Vector3d c = inverse * right;
  FlankFit fit;
  const double discriminant = c[1] * c[1] - 4.0 * c[2] * c[0];
  if (!(discriminant > 0.0)) return fit;
  const double slope = std::sqrt(discriminant);
  fit.start = -2.0 * c[0] / (c[1] + slope);
  if (!(fit.start < at(first) + speed.Interval())) return FlankFit();
  const Eigen::Vector3d change = Eigen::Vector3d(1.0, fit.start, fit.start * fit.start) / slope;
  fit.variance = change.dot(inverse * change);
  for (size_t i = first; i <= last; ++i) {
    if (!speed.IsValid(i) || !(value(i) > 0.0)) continue;
    const double root = c[0] + c[1] * at(i) + c[2] * at(i) * at(i);
    const double error = std::pow(std::max(0.0, root), exponent) - value(i);
    fit.squares += error * error;
  }
  return fit;
}

/** @param peak  its sample. */
EventTime FindStart(const ScalarCurve& speed, size_t peak) {
  const double top = speed.At(peak);
  const double low = std::max(0.04 * top, 4.0 * speed.noise);
  size_t last = peak;
  while (last > 0 && !(speed.At(last) <= 0.6 * top)) --last;
  size_t first = last;
  while (first > 0 && speed.At(first - 1) > low) --first;
  const double count = static_cast<double>(last + 1 - first);
  if (count < 8.0) return MissingEvent("fewer than eight samples on the rising flank");
  std::vector<FlankFit> fits;
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step <= 13; ++step) {
    const FlankFit fit = FitFlank(speed, first, last, 1.0 + 0.2 * step);
    if (std::isnan(fit.start)) continue;
    least = std::min(least, fit.squares);
    fits.push_back(fit);
  }
  if (fits.empty()) return MissingEvent("the rising flank does not lead to zero");
  // A filter makes neighbours alike: samples as far apart as its reach are independent.
  const double samples = std::max(1.0, 2.0 * speed.reach / speed.Interval());
  const double variance =
      samples * std::max(least / (count - 4.0), speed.noise * speed.noise / samples);
  double sum = 0.0, weights = 0.0;
  for (const FlankFit& fit : fits) {
    const double weight = std::exp(-0.5 * (fit.squares - least) / variance);
    sum += weight * fit.start;
    weights += weight;
  }
  EventTime event;
  const double mean = sum / weights;
  double spread = 0.0;
  for (const FlankFit& fit : fits) {
    const double weight = std::exp(-0.5 * (fit.squares - least) / variance) / weights;
    spread += weight * (std::pow(fit.start - mean, 2) + variance * fit.variance);
  }
  event.time = speed.times[first] + mean;
  event.uncertainty = std::hypot(std::sqrt(spread), speed.Interval() / std::sqrt(12.0));
  event.is_filled = HasFilledNear(speed, event.time);
  return event;
}

double FindSlowestBefore(const ScalarCurve& speed, size_t peak) {
  double slowest = std::numeric_limits<double>::quiet_NaN();
  for (size_t i = 0; i < peak; ++i) {
    if (speed.IsValid(i)) slowest = std::fmin(slowest, speed.At(i));
  }
  return slowest;
}

/** Shape and length of the movement, for what goes with them (CalcSharedTiming). */
void DescribeRise(const ScalarCurve& speed, size_t peak, Movement& movement) {
  for (size_t i = 0; i < kRiseShares.size(); ++i) {
    const EventTime event =
        TraceBack(speed, peak, 0, kRiseShares[i] * movement.peak_speed, Side::kAbove);
    if (event.IsFound()) movement.rise[i] = event.time;
  }
  // Noise of the speed over its slope there.
  const double climb = (kRiseShares[1] - kRiseShares[0]) * movement.peak_speed;
  movement.rise_noise = std::hypot(speed.noise * (movement.rise[1] - movement.rise[0]) / climb,
                                   speed.Interval() / std::sqrt(12.0));
  movement.distance = 0.0;
  for (const int side : {-1, 1}) {
    for (size_t i = peak; i < speed.size(); i += static_cast<size_t>(side)) {
      const double value = speed.At(i);
      if (value < kRiseShares[0] * movement.peak_speed) break;
      if (speed.IsValid(i) && (side > 0 || i != peak))
        movement.distance += value * speed.Interval();
      if (i == 0) break;
    }
  }
}

}  // namespace

const std::vector<MovementRule>& MovementRuleList() {
  static const std::vector<MovementRule> rules = {
      {"threshold", "speed traced back from its peak to a fixed threshold", FindThreshold},
      {"peak_fraction", "speed traced back from its peak to a fixed share of the peak",
       FindPeakFraction},
      {"longest_run", "first sample of the longest stretch above a fixed threshold (kinesis)",
       FindLongestRun},
      {"baseline",
       "speed traced back to the mean plus two standard deviations of a quiet window that ends "
       "0.1 s before a fixed threshold (after Luciw et al. 2014)",
       FindBaseline},
      {"regression",
       "root of a parabola through the square root of speed on the rising flank, exact for "
       "minimum-jerk movements (after Botzer and Karniel 2009); its lowest point where the hand "
       "turns without stopping",
       FindRegression},
      {"multiplied",
       "largest product of being slow and being late (after Schot, Brenner and Smeets 2010)",
       FindMultiplied},
  };
  return rules;
}

const MovementRule& FindMovementRule(const std::string& id) {
  std::vector<std::string> known;
  for (const MovementRule& rule : MovementRuleList()) {
    if (rule.id == id) return rule;
    known.push_back(rule.id);
  }
  throw Error(ErrorKind::kNotFound, "no movement rule \"" + id + "\"" + SuggestNames(id, known));
}

Movement FindMovement(const ScalarCurve& whole, double begin, double end,
                      const MovementOptions& options) {
  const MovementRule& rule = FindMovementRule(options.rule);
  Movement movement;
  const ScalarCurve speed = Cut(whole, FindSamples(whole.times, begin, end));
  const int peak = FindPeak(speed, {0, speed.size()});
  if (peak < 0 || peak == 0 || peak + 1 == static_cast<int>(speed.size())) {
    movement.onset = movement.end = movement.start =
        MissingEvent("no peak of speed between the start and the hold");
    return movement;
  }
  movement.peak_speed = speed.values[peak];
  movement.peak_time = speed.times[static_cast<size_t>(peak)];
  movement.slowest_before = FindSlowestBefore(speed, static_cast<size_t>(peak));
  movement.onset = rule.find_onset(speed, static_cast<size_t>(peak), options);
  movement.start = FindStart(speed, static_cast<size_t>(peak));
  DescribeRise(speed, static_cast<size_t>(peak), movement);
  movement.end =
      rule.find_onset(Reverse(speed), speed.size() - 1 - static_cast<size_t>(peak), options);
  movement.end.time = -movement.end.time;
  return movement;
}

namespace {

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
