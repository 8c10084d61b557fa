#include "human_study/events/scalar_curve.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/statistics/summary.h"
#include "human_study/recording/cleaning/butterworth.h"

namespace graspbench {
namespace {

using Column = Eigen::Index;

/** What a filter makes of white noise of SD 1. */
struct NoiseShares {
  double taken = 0.0;  ///< SD of input minus output
  double left = 0.0;   ///< SD of the output
  double rate = 0.0;   ///< SD of the output's central difference [1/s]
};

/** From the impulse response: variances of white noise add up. */
NoiseShares CalcNoiseSharesOnce(const Biquad& pass, double sampling_rate) {
  constexpr Column kHalfLength = 200;  // samples, many times the response of any cut-off in use
  Eigen::VectorXd impulse = Eigen::VectorXd::Zero(2 * kHalfLength + 1);
  impulse[kHalfLength] = 1.0;
  const Eigen::VectorXd response = FilterZeroPhase(pass, impulse);
  const Eigen::VectorXd difference =
      response.tail(impulse.size() - 2) - response.head(impulse.size() - 2);
  return {(impulse - response).norm(), response.norm(), difference.norm() * sampling_rate / 2};
}

/** The digits of a trial are filtered alike: the last answers are kept. */
NoiseShares CalcNoiseShares(const Biquad& pass, double sampling_rate) {
  struct Known {
    Biquad pass;
    double rate = 0.0;
    NoiseShares shares;
  };
  thread_local std::array<Known, 8> all;
  thread_local size_t next = 0;
  for (const Known& known : all) {
    const bool is_same = known.rate == sampling_rate && known.pass.b0 == pass.b0 &&
                         known.pass.a1 == pass.a1 && known.pass.a2 == pass.a2;
    if (is_same) return known.shares;
  }
  Known& known = all[next];
  next = (next + 1) % all.size();
  known = {pass, sampling_rate, CalcNoiseSharesOnce(pass, sampling_rate)};
  return known.shares;
}

/** Event between sample `before`, still on the other side, and sample `after`. */
EventTime MakeCrossing(const ScalarCurve& curve, size_t before, size_t after, double threshold) {
  const double t0 = curve.times[before], t1 = curve.times[after];
  EventTime event;
  double variance = (t1 - t0) * (t1 - t0) / 12.0;
  if (after - before > 1) {
    event.time = (t0 + t1) / 2;
    event.is_in_gap = true;
  } else {
    const double y0 = curve.At(before);
    const double y1 = curve.At(after);
    event.time = t0 + (t1 - t0) * (threshold - y0) / (y1 - y0);
    const double slope = (y1 - y0) / (t1 - t0);
    variance += curve.noise * curve.noise / (slope * slope);
  }
  event.uncertainty = std::sqrt(variance);
  event.is_filled = HasFilledNear(curve, event.time);
  return event;
}

/** As TraceBack, without the share of the rule in the uncertainty. */
EventTime TraceBackOnce(const ScalarCurve& curve, size_t from, size_t first, double threshold,
                        Side side, double min_duration) {
  const auto is_inside = [&](size_t i) {
    const double value = curve.At(i);
    return side == Side::kAbove ? value > threshold : value < threshold;
  };
  if (!curve.IsValid(from) || !is_inside(from)) {
    return MissingEvent("the search starts on the wrong side of the threshold");
  }
  // The crossing last seen is believed once the curve has stayed beyond it for long enough.
  size_t after = from, crossing = from;
  bool is_beyond = false;
  for (size_t i = from; i-- > first;) {
    if (!curve.IsValid(i)) continue;
    if (is_inside(i)) {
      is_beyond = false;
      after = i;
      continue;
    }
    if (!is_beyond) crossing = i;
    is_beyond = true;
    if (curve.times[crossing] - curve.times[i] >= min_duration) {
      return MakeCrossing(curve, crossing, after, threshold);
    }
  }
  return MissingEvent("the threshold is never crossed before");
}

}  // namespace

SampleState CombineStates(SampleState a, SampleState b) { return std::max(a, b); }

SmoothPath Smooth(const Trajectory& trajectory, double cutoff) {
  SmoothPath smooth;
  smooth.path = trajectory;
  FilterLowPass(smooth.path, cutoff);
  const double rate = static_cast<double>(trajectory.size() - 1) /
                      (trajectory.times.back() - trajectory.times.front());
  std::vector<double> taken_away;
  for (size_t i = 0; i < trajectory.size(); ++i) {
    if (trajectory.states[i] != SampleState::kMeasured) continue;
    const auto column = static_cast<Column>(i);
    taken_away.push_back((trajectory.p.col(column) - smooth.path.p.col(column)).norm());
  }
  const NoiseShares shares = CalcNoiseShares(MakeLowPass(cutoff, rate), rate);
  smooth.noise = taken_away.empty() ? 0.0 : CalcMedian(taken_away) / (kMedianPerSd * shares.taken);
  smooth.smooth_noise = shares.left * smooth.noise;
  smooth.speed_noise = shares.rate * smooth.noise;
  smooth.reach = 0.18 / cutoff;
  return smooth;
}

ScalarCurve CalcSpeed(const SmoothPath& smooth) {
  const Trajectory& path = smooth.path;
  ScalarCurve speed;
  speed.times = path.times;
  speed.states.assign(path.size(), SampleState::kInvalid);
  speed.values = Eigen::VectorXd::Constant(static_cast<Column>(path.size()), std::nan(""));
  speed.noise = smooth.speed_noise;
  speed.reach = smooth.reach;
  for (const SampleRun& run : FindValidRuns(path)) {
    if (run.size() < 2) continue;
    const double begin = run.first == 0 ? path.times.front() : path.times[run.first] + speed.reach;
    const double end =
        run.last == path.size() ? path.times.back() : path.times[run.last - 1] - speed.reach;
    for (size_t i = run.first; i < run.last; ++i) {
      if (path.times[i] < begin || path.times[i] > end) continue;
      const size_t before = std::max(i, run.first + 1) - 1, after = std::min(i + 1, run.last - 1);
      const Eigen::Vector3d step = path.At(after) - path.At(before);
      speed.At(i) = step.norm() / (path.times[after] - path.times[before]);
      speed.states[i] = path.states[i];
    }
  }
  return speed;
}

ScalarCurve Reverse(const ScalarCurve& curve) {
  ScalarCurve reversed = curve;
  std::reverse(reversed.times.begin(), reversed.times.end());
  for (double& time : reversed.times) time = -time;
  reversed.values = curve.values.reverse();
  std::reverse(reversed.states.begin(), reversed.states.end());
  return reversed;
}

SampleRun FindSamples(const std::vector<double>& times, double begin, double end) {
  const auto first = std::lower_bound(times.begin(), times.end(), begin);
  const auto last = std::upper_bound(first, times.end(), end);
  return {static_cast<size_t>(first - times.begin()), static_cast<size_t>(last - times.begin())};
}

ScalarCurve Cut(const ScalarCurve& curve, const SampleRun& samples) {
  ScalarCurve part = curve;
  const auto first = static_cast<std::ptrdiff_t>(samples.first);
  const auto last = static_cast<std::ptrdiff_t>(samples.last);
  part.times.assign(curve.times.begin() + first, curve.times.begin() + last);
  part.states.assign(curve.states.begin() + first, curve.states.begin() + last);
  part.values = curve.values.segment(first, last - first);
  return part;
}

ScalarCurve Thin(const ScalarCurve& curve, size_t num_samples) {
  const size_t step = curve.size() / num_samples;
  if (step < 2) return curve;
  ScalarCurve thin;
  thin.noise = curve.noise;
  thin.rate_noise = curve.rate_noise;
  thin.reach = curve.reach;
  const size_t count = (curve.size() + step - 1) / step;
  thin.times.reserve(count);
  thin.states.reserve(count);
  thin.values.resize(static_cast<Eigen::Index>(count));
  for (size_t i = 0; i < count; ++i) {
    thin.times.push_back(curve.times[step * i]);
    thin.states.push_back(curve.states[step * i]);
    thin.At(i) = curve.At(step * i);
  }
  return thin;
}

double ValueNear(const ScalarCurve& curve, double time) {
  const SampleRun run =
      FindSamples(curve.times, time - curve.Interval() / 2, time + curve.Interval());
  return run.size() == 0 ? std::nan("") : curve.At(run.first);
}

int FindPeak(const ScalarCurve& curve, const SampleRun& samples) {
  int peak = -1;
  for (size_t i = samples.first; i < samples.last; ++i) {
    if (!curve.IsValid(i)) continue;
    if (peak < 0 || curve.At(i) > curve.values[peak]) {
      peak = static_cast<int>(i);
    }
  }
  return peak;
}

bool HasFilledNear(const ScalarCurve& curve, double time) {
  // One interval more than the filter's reach: derivatives take the neighbours.
  const double reach = curve.reach + 1.001 * curve.Interval();
  const SampleRun near = FindSamples(curve.times, time - reach, time + reach);
  for (size_t i = near.first; i < near.last; ++i) {
    if (curve.states[i] == SampleState::kFilled) return true;
  }
  return false;
}

EventTime FindProductPeak(const ScalarCurve& product) {
  const int peak = FindPeak(product, {0, product.size()});
  if (peak < 0 || !(product.values[peak] > 0.0)) {
    return MissingEvent("the criteria are never met together");
  }
  const auto at = static_cast<size_t>(peak);
  const auto is_near = [&](size_t i) {
    return !product.IsValid(i) || product.At(i) > 0.95 * product.values[peak];
  };
  size_t first = at, last = at;
  while (first > 0 && is_near(first - 1)) --first;
  while (last + 1 < product.size() && is_near(last + 1)) ++last;

  EventTime event;
  event.time = product.times[at];
  event.is_in_gap =
      (at > 0 && !product.IsValid(at - 1)) || (at + 1 < product.size() && !product.IsValid(at + 1));
  if (!event.is_in_gap && at > 0 && at + 1 < product.size()) {
    const double before = product.values[peak - 1], after = product.values[peak + 1];
    const double bend = before - 2 * product.values[peak] + after;
    if (bend < 0.0) event.time += product.Interval() * (before - after) / (2 * bend);
  }
  const double width = std::max(product.times[last] - product.times[first], product.Interval());
  event.uncertainty = std::hypot(width / std::sqrt(12.0), product.reach / std::sqrt(3.0));
  event.is_filled = HasFilledNear(product, event.time);
  return event;
}

EventTime TraceBack(const ScalarCurve& curve, size_t from, size_t first, double threshold,
                    Side side, double min_duration) {
  EventTime event = TraceBackOnce(curve, from, first, threshold, side, min_duration);
  if (!event.IsFound()) return event;
  double earliest = event.time, latest = event.time;
  for (const double factor : {0.5, 1.5}) {
    const EventTime other =
        TraceBackOnce(curve, from, first, factor * threshold, side, min_duration);
    if (!other.IsFound()) continue;
    earliest = std::min(earliest, other.time);
    latest = std::max(latest, other.time);
  }
  event.uncertainty = std::hypot(event.uncertainty, (latest - earliest) / std::sqrt(12.0));
  return event;
}

int FindFirstAbove(const ScalarCurve& curve, double threshold) {
  for (size_t i = 0; i < curve.size(); ++i) {
    const auto sample = static_cast<Eigen::Index>(i);
    if (curve.IsValid(i) && curve.values[sample] > threshold) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace graspbench
