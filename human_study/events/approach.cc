#include "human_study/events/approach.h"

#include <algorithm>
#include <cmath>

#include "core/statistics/summary.h"
#include "human_study/events/scalar_curve.h"

namespace graspbench {
namespace {

using Column = Eigen::Index;
using Eigen::Vector3d;

constexpr double kDeepest = 5e-3;       // farther from its place no digit touches [m]
constexpr double kNoiseFactor = 6.0;    // .. or this many SD of the noise
constexpr double kRestTime = 0.05;      // a tip rests whose mean over this has arrived [s]
constexpr double kSlack = 0.03;         // the touch may lie this much later than the rest [s]
constexpr double kBefore = 0.06;        // samples taken before the bracket [s]
constexpr double kAfter = 0.08;         // .. and after it [s]
constexpr size_t kMinBefore = 5;        // samples, from farther back where some are hidden
constexpr double kFarthestBack = 0.15;  // [s]
constexpr double kLongest = 1.5;        // no digit touches earlier before the hold [s]
constexpr double kTick = 1e-6;          // [s] rounding of the clock decides nothing
constexpr double kUsefulRate = 200.0;   // more samples than that are averaged [Hz]

struct Clearances {
  std::vector<double> times, values;
  double interval = 0.0;  ///< of the trial's clock [s]
};

template <class Measure>
Clearances MeasureBefore(const Trajectory& p_O, const Hold& hold, const Measure& measure) {
  Clearances clearances;
  clearances.interval = p_O.times[1] - p_O.times[0];
  const SampleRun run = FindSamples(p_O.times, hold.time - kLongest, hold.end);
  for (size_t i = run.first; i < run.last; ++i) {
    if (p_O.states[i] != SampleState::kMeasured) continue;
    clearances.times.push_back(p_O.times[i]);
    clearances.values.push_back(measure(Vector3d(p_O.p.col(static_cast<Column>(i)))));
  }
  return clearances;
}

/** First sample from `from` on whose mean over the next stretch is near rest. */
size_t FindRest(const Clearances& clearances, size_t from, double near) {
  for (size_t i = from; i < clearances.times.size(); ++i) {
    double sum = 0.0;
    size_t k = i;
    while (k < clearances.times.size() &&
           clearances.times[k] < clearances.times[i] + kRestTime - kTick) {
      sum += clearances.values[k++];
    }
    if (sum < near * static_cast<double>(k - i)) return i;
  }
  return clearances.times.size() - 1;
}

/** Neighbours without a gap between them averaged, so that few samples are left. */
void Thin(double interval, TouchSamples& samples) {
  const auto size = static_cast<size_t>(1.0 / (kUsefulRate * interval) + 1e-6);
  if (size < 2) return;
  std::vector<double> times, places;
  for (size_t i = 0; i + size <= samples.times.size(); ++i) {
    if (samples.times[i + size - 1] - samples.times[i] > (size - 0.5) * interval) continue;
    double time = 0.0, place = 0.0;
    for (size_t k = i; k < i + size; ++k) {
      time += samples.times[k] / static_cast<double>(size);
      place += samples.places[k] / static_cast<double>(size);
    }
    times.push_back(time);
    places.push_back(place);
    i += size - 1;
  }
  samples.times = times;
  samples.places = places;
  samples.noise /= std::sqrt(static_cast<double>(size));
}

TouchSamples CutApproach(const Clearances& clearances, double hold, double noise) {
  const std::vector<double>& times = clearances.times;
  const double deepest = std::max(kDeepest, kNoiseFactor * noise);
  auto far =
      static_cast<Column>(std::upper_bound(times.begin(), times.end(), hold) - times.begin());
  while (--far >= 0 && clearances.values[static_cast<size_t>(far)] <= deepest) {
  }
  if (far < 0) return {};
  TouchSamples samples;
  samples.noise = noise;
  samples.first = times[static_cast<size_t>(far)];
  const size_t rest =
      FindRest(clearances,
               static_cast<size_t>(far) + 1 < times.size() ? static_cast<size_t>(far) + 1
                                                           : static_cast<size_t>(far),
               std::max(1e-4, noise / 2.0));
  samples.last = std::min(times[rest] + kSlack, times.back());
  if (!(samples.first < samples.last)) return {};
  for (size_t i = 0; i < times.size() && times[i] <= samples.last + kAfter + kTick; ++i) {
    const bool is_near = times[i] >= samples.first - kBefore - kTick;
    const bool is_needed = i + kMinBefore > static_cast<size_t>(far) &&
                           times[i] >= samples.first - kFarthestBack - kTick;
    if (!is_near && !is_needed) continue;
    samples.times.push_back(times[i]);
    samples.places.push_back(clearances.values[i]);
  }
  Thin(clearances.interval, samples);
  return samples;
}

/** Mean of the measured samples before the hold whose last departures lie in a range; NaN without
any. */
Vector3d CalcMeanWithin(const Trajectory& p_O, const Vector3d& place, double hold, double near,
                        double far) {
  Vector3d sum = Vector3d::Zero();
  double count = 0.0;
  const SampleRun run = FindSamples(p_O.times, p_O.times.front(), hold);
  for (size_t i = run.last; i-- > run.first;) {
    if (p_O.states[i] != SampleState::kMeasured) continue;
    const Vector3d p = p_O.p.col(static_cast<Column>(i));
    const double departure = (p - place).norm();
    if (departure > far) break;
    if (departure < near) continue;
    sum += p;
    count += 1.0;
  }
  return sum / count;
}

/** Of the approach, unit; NaN when it is not seen. */
Vector3d FindDirection(const Trajectory& p_O, const Vector3d& place, double hold) {
  const Vector3d far = CalcMeanWithin(p_O, place, hold, 6e-3, 10e-3);
  const Vector3d near = CalcMeanWithin(p_O, place, hold, 3e-3, 6e-3);
  if (far.hasNaN()) return (CalcMeanWithin(p_O, place, hold, 3.5e-3, 60e-3) - place).normalized();
  return (near.hasNaN() ? Vector3d(far - place) : Vector3d(far - near)).normalized();
}

Vector3d CalcMeanBetween(const Trajectory& p_O, double begin, double end) {
  Vector3d sum = Vector3d::Zero();
  double count = 0.0;
  const SampleRun run = FindSamples(p_O.times, begin - kTick, end + kTick);
  for (size_t i = run.first; i < run.last; ++i) {
    if (p_O.states[i] != SampleState::kMeasured) continue;
    sum += p_O.p.col(static_cast<Column>(i));
    count += 1.0;
  }
  return sum / count;
}

/** From just before to just after it arrives: the rest of the way may turn, and so may the phalanx
in the hold. */
Vector3d RefineDirection(const Trajectory& p_O, const Vector3d& direction, const Vector3d& place,
                         const Hold& hold, double noise) {
  constexpr double kArrived = 1e-3;  // [m]
  const double near = kArrived + 2.0 * noise;
  const SampleRun run = FindSamples(p_O.times, hold.time - kLongest, hold.time);
  for (size_t i = run.last; i-- > run.first;) {
    if (p_O.states[i] != SampleState::kMeasured) continue;
    if (direction.dot(p_O.p.col(static_cast<Column>(i)) - place) < near) continue;
    const double arrival = p_O.times[i];
    const Vector3d refined = CalcMeanBetween(p_O, arrival - 0.04, arrival) -
                             CalcMeanBetween(p_O, arrival + 0.01, arrival + 0.05);
    return refined.hasNaN() ? direction : Vector3d(refined.normalized());
  }
  return direction;
}

/** Mean without those that are far off, in no frame's terms; NaN without any. */
Vector3d CalcMiddle(const std::vector<Vector3d>& places) {
  constexpr double kFarOff = 4.0;  // medians of the distance
  const auto mean_within = [&](const Vector3d& middle, double limit) {
    Vector3d sum = Vector3d::Zero();
    double count = 0.0;
    for (const Vector3d& place : places) {
      if ((place - middle).norm() > limit) continue;
      sum += place;
      count += 1.0;
    }
    return Vector3d(sum / count);
  };
  Vector3d middle = mean_within(Vector3d::Zero(), INFINITY);
  for (int round = 0; round < 2 && !places.empty(); ++round) {
    std::vector<double> distances;
    for (const Vector3d& place : places) distances.push_back((place - middle).norm());
    middle = mean_within(middle, kFarOff * CalcMedian(distances) + 1e-9);
  }
  return middle;
}

}  // namespace

Vector3d FindHoldPlace(const Trajectory& p_O, const Hold& hold) {
  std::vector<std::pair<double, size_t>> seen;  // by distance from the instant of the hold
  const SampleRun run = FindSamples(p_O.times, hold.begin, hold.end);
  for (size_t i = run.first; i < run.last; ++i) {
    if (p_O.states[i] != SampleState::kMeasured) continue;
    seen.emplace_back(std::abs(p_O.times[i] - hold.time), i);
  }
  std::sort(seen.begin(), seen.end());
  std::vector<Vector3d> places;
  for (size_t k = 0; k < seen.size(); ++k) {
    const double since = p_O.times[seen[k].second] - hold.time;
    if (k >= 10 && (since < -0.05 || since > 0.1)) continue;
    places.emplace_back(p_O.p.col(static_cast<Column>(seen[k].second)));
  }
  return CalcMiddle(places);
}

TouchSamples TakeApproachToSurface(const Trajectory& p_O, const SurfaceDistance& distance,
                                   const Vector3d& place, const Hold& hold, double noise,
                                   double pad_offset) {
  if (place.hasNaN()) return {};
  const double rest = distance(place);
  TouchSamples samples =
      CutApproach(MeasureBefore(p_O, hold, [&](const Vector3d& p) { return distance(p) - rest; }),
                  hold.time, noise);
  samples.touch_place = pad_offset - rest;
  return samples;
}

TouchSamples TakeApproachToPlace(const Trajectory& p_O, const Vector3d& place, const Hold& hold,
                                 double noise) {
  if (place.hasNaN()) return {};
  const Vector3d coarse = FindDirection(p_O, place, hold.time);
  if (coarse.hasNaN()) return {};
  const Vector3d direction = RefineDirection(p_O, coarse, place, hold, noise);
  return CutApproach(
      MeasureBefore(p_O, hold, [&](const Vector3d& p) { return direction.dot(p - place); }),
      hold.time, noise);
}

}  // namespace graspbench
