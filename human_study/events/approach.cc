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
constexpr double kBeyond = 1e-3;        // past its place by more than this it passes [m]
constexpr double kRestTime = 0.05;      // a tip rests whose mean over this has arrived [s]
constexpr double kSlack = 0.03;         // the touch may lie this much later than the rest [s]
constexpr double kBefore = 0.06;        // samples taken before the bracket [s]
constexpr double kAfter = 0.08;         // .. and after it [s]
constexpr size_t kMinBefore = 5;        // samples, from farther back where some are hidden
constexpr double kFarthestBack = 0.15;  // [s]
constexpr double kLongest = 1.5;        // no digit touches earlier before the hold [s]
constexpr double kFarAway = 25e-3;  // a tip this far from its place in the hold is on its way [m]
constexpr double kMeanTime = 0.04;  // over which a way is averaged for its direction [s]
constexpr double kClear = 5.0;      // SD of its noise beyond which a mean is off its place
constexpr double kTick = 1e-6;      // [s] rounding of the clock decides nothing
constexpr double kUsefulRate = 200.0;  // more samples than that are averaged [Hz]

/** Measured samples up to the hold's end. */
struct Clearances {
  std::vector<double> times, values;
  std::vector<bool> is_away;  ///< the tip is elsewhere, whatever the clearance says
  double interval = 0.0;      ///< of the trial's clock [s]
};

/** A tip's measured samples, each with the mean of those about it. */
struct Way {
  std::vector<double> times;
  std::vector<Vector3d> raw, mean;
  double noise = 0.0;  ///< SD of a coordinate of a mean [m]
};

Way TakeWay(const Trajectory& p_O, const Hold& hold, double noise) {
  Way way;
  const SampleRun run = FindSamples(p_O.times, p_O.times.front(), hold.end);
  for (size_t i = run.first; i < run.last; ++i) {
    if (p_O.states[i] != SampleState::kMeasured) continue;
    way.times.push_back(p_O.times[i]);
    way.raw.emplace_back(p_O.At(i));
  }
  Vector3d sum = Vector3d::Zero();
  size_t first = 0, last = 0;  // of the samples in the sum
  const double half = kMeanTime / 2.0 + kTick;
  for (size_t i = 0; i < way.times.size(); ++i) {
    while (last < way.times.size() && way.times[last] <= way.times[i] + half)
      sum += way.raw[last++];
    while (way.times[first] < way.times[i] - half) sum -= way.raw[first++];
    way.mean.push_back(sum / static_cast<double>(last - first));
  }
  const double interval = p_O.times[1] - p_O.times[0];
  way.noise = noise / std::sqrt(std::max(1.0, std::floor(kMeanTime / interval + kTick) + 1.0));
  return way;
}

template <class Measure>
Clearances MeasureBefore(const Trajectory& p_O, const Hold& hold, const Measure& measure) {
  Clearances clearances;
  clearances.interval = p_O.times[1] - p_O.times[0];
  const SampleRun run = FindSamples(p_O.times, hold.time - kLongest, hold.end);
  for (size_t i = run.first; i < run.last; ++i) {
    if (p_O.states[i] != SampleState::kMeasured) continue;
    clearances.times.push_back(p_O.times[i]);
    clearances.values.push_back(measure(Vector3d(p_O.At(i))));
  }
  clearances.is_away.assign(clearances.times.size(), false);
  return clearances;
}

/** A tip that passes far beside its place does not touch there. */
void MarkAway(const Way& way, const Vector3d& place, double noise, Clearances& clearances) {
  const double far_away = std::max(kFarAway, kNoiseFactor * noise);
  const size_t num_earlier = way.times.size() - clearances.times.size();
  for (size_t i = 0; i < clearances.times.size(); ++i) {
    clearances.is_away[i] = (way.mean[num_earlier + i] - place).norm() > far_away;
  }
}

/** First sample from `from` on whose mean over the next stretch is near rest. */
size_t FindRest(const Clearances& clearances, size_t from, double near) {
  const double beyond = std::max(kBeyond, 4.0 * near);
  for (size_t i = from; i < clearances.times.size(); ++i) {
    double sum = 0.0;
    size_t k = i;
    while (k < clearances.times.size() &&
           clearances.times[k] < clearances.times[i] + kRestTime - kTick) {
      sum += clearances.values[k++];
    }
    const double mean = sum / static_cast<double>(k - i);
    if (mean < near && mean > -beyond) return i;
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
  const auto is_here = [&](Column i) {
    const auto at = static_cast<size_t>(i);
    return clearances.values[at] <= deepest && !clearances.is_away[at];
  };
  while (--far >= 0 && is_here(far)) {
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

/** Mean of the way before the hold where its last departures lie in a range; NaN without any. */
Vector3d CalcMeanWithin(const Way& way, const Vector3d& place, double hold, double near,
                        double far) {
  Vector3d sum = Vector3d::Zero();
  double count = 0.0;
  for (size_t i = FindSamples(way.times, way.times.front(), hold).last; i-- > 0;) {
    const double departure = (way.mean[i] - place).norm();
    if (departure > far) break;
    if (departure < near) continue;
    sum += way.mean[i];
    count += 1.0;
  }
  return sum / count;
}

/** Of the approach, unit; NaN when it is not seen. Noise alone does not depart as far as `near`. */
Vector3d FindDirection(const Way& way, const Vector3d& place, double hold) {
  const double near = std::max(3e-3, kClear * way.noise), middle = 2.0 * near;
  const Vector3d outer = CalcMeanWithin(way, place, hold, middle, middle + 4e-3);
  const Vector3d inner = CalcMeanWithin(way, place, hold, near, middle);
  if (outer.hasNaN()) {
    return (CalcMeanWithin(way, place, hold, near, 60e-3) - place).normalized();
  }
  return (inner.hasNaN() ? Vector3d(outer - place) : Vector3d(outer - inner)).normalized();
}

Vector3d CalcMeanBetween(const Way& way, double begin, double end) {
  Vector3d sum = Vector3d::Zero();
  double count = 0.0;
  const SampleRun run = FindSamples(way.times, begin - kTick, end + kTick);
  for (size_t i = run.first; i < run.last; ++i) {
    sum += way.raw[i];
    count += 1.0;
  }
  return sum / count;
}

/** From just before to just after it arrives: the rest of the way may turn, and so may the phalanx
in the hold. As before where that is not clear of the noise. */
Vector3d RefineDirection(const Way& way, const Vector3d& direction, const Vector3d& place,
                         const Hold& hold) {
  constexpr double kArrived = 1e-3;  // [m]
  const double near = kArrived + 3.0 * way.noise;
  for (size_t i = FindSamples(way.times, way.times.front(), hold.time).last; i-- > 0;) {
    if (way.times[i] < hold.time - kLongest) break;
    if (direction.dot(way.mean[i] - place) < near) continue;
    const double arrival = way.times[i];
    const Vector3d refined = CalcMeanBetween(way, arrival - 0.04, arrival) -
                             CalcMeanBetween(way, arrival + 0.01, arrival + 0.05);
    return refined.norm() > kClear * way.noise ? Vector3d(refined.normalized()) : direction;
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
    places.emplace_back(p_O.At(seen[k].second));
  }
  return CalcMiddle(places);
}

TouchSamples TakeApproachToSurface(const Trajectory& p_O, const SurfaceDistance& distance,
                                   const Vector3d& place, const Hold& hold, double noise,
                                   double pad_offset) {
  if (place.hasNaN()) return {};
  const double rest = distance(place);
  Clearances clearances =
      MeasureBefore(p_O, hold, [&](const Vector3d& p) { return distance(p) - rest; });
  MarkAway(TakeWay(p_O, hold, noise), place, noise, clearances);
  TouchSamples samples = CutApproach(clearances, hold.time, noise);
  samples.touch_place = pad_offset - rest;
  return samples;
}

TouchSamples TakeApproachToPlace(const Trajectory& p_O, const Vector3d& place, const Hold& hold,
                                 double noise, const Vector3d& from, double after) {
  if (place.hasNaN()) return {};
  const Way way = TakeWay(p_O, hold, noise);
  if (way.times.empty()) return {};
  const Vector3d coarse = from.hasNaN() ? FindDirection(way, place, hold.time) : from;
  if (coarse.hasNaN()) return {};
  const Vector3d direction = RefineDirection(way, coarse, place, hold);
  Clearances clearances =
      MeasureBefore(p_O, hold, [&](const Vector3d& p) { return direction.dot(p - place); });
  MarkAway(way, place, noise, clearances);
  for (size_t i = 0; i < clearances.times.size() && clearances.times[i] < after; ++i) {
    clearances.is_away[i] = true;
  }
  TouchSamples samples = CutApproach(clearances, hold.time, noise);
  samples.direction = direction;
  return samples;
}

namespace {

/** Slope of the places over a stretch, and its standard deviation [m/s]; NaN below three samples. */
struct Slope {
  double value = std::nan(""), sd = std::nan("");
};
Slope CalcSlope(const TouchSamples& samples, const std::vector<double>& places, double begin,
                double end) {
  const SampleRun run = FindSamples(samples.times, begin - kTick, end + kTick);
  if (run.size() < 3) return {};
  double time = 0.0, place = 0.0, squares = 0.0, products = 0.0;
  const auto count = static_cast<double>(run.size());
  for (size_t i = run.first; i < run.last; ++i) {
    time += samples.times[i] / count;
    place += places[i] / count;
  }
  for (size_t i = run.first; i < run.last; ++i) {
    const double since = samples.times[i] - time;
    squares += since * since;
    products += since * (places[i] - place);
  }
  return {products / squares, samples.noise / std::sqrt(squares)};
}

}  // namespace

TouchSamples TakeEarlierStop(const TouchSamples& samples, double touch) {
  constexpr double kWindow = 0.03, kApart = 0.04;  // [s]
  constexpr double kFast = 0.05;                   // [m/s]
  constexpr double kLeast = 0.3e-3, kMost = 4e-3;  // that it still goes [m]
  constexpr double kStopped = 0.25, kCrept = 0.4;  // of the speed before
  const auto slope = [&](double begin, double end) {
    return CalcSlope(samples, samples.places, begin, end);
  };
  std::vector<double> own = samples.places;  // the digit's way, whatever the object does
  for (size_t i = 0; i < samples.object_motion.size(); ++i) own[i] += samples.object_motion[i];
  double at = std::nan(""), most = 0.0;
  for (const double time : samples.times) {
    if (time < samples.first || time > touch - kApart) continue;
    const Slope before = slope(time - kWindow, time);
    const Slope after = slope(time, time + kWindow);
    const double drop = after.value - before.value;
    if (!(-before.value > kFast && -after.value < kStopped * -before.value)) continue;
    if (!(drop > kClear * std::hypot(before.sd, after.sd) && drop > most)) continue;
    const double own_drop = CalcSlope(samples, own, time, time + kWindow).value -
                            CalcSlope(samples, own, time - kWindow, time).value;
    if (!(own_drop > 0.5 * drop)) continue;  // an object that is pushed away stops no digit
    bool creeps = true;
    for (const double later : samples.times) {
      if (later < time || later > touch) continue;
      creeps = creeps &&
               !(-slope(later, later + kWindow).value > kCrept * -before.value + 2.0 * after.sd);
    }
    if (!creeps) continue;
    at = time;
    most = drop;
  }
  if (std::isnan(at)) return {};
  TouchSamples stop = samples;
  stop.last = at + kSlack;
  const SampleRun rest = FindSamples(samples.times, at + kWindow / 2.0, stop.last + kWindow);
  double place = 0.0;
  for (size_t i = rest.first; i < rest.last; ++i) {
    place += samples.places[i] / static_cast<double>(rest.size());
  }
  if (!(place > kLeast && place < kMost)) return {};
  const size_t size = FindSamples(samples.times, at, stop.last + kWindow).last;
  stop.times.resize(size);
  stop.places.resize(size);
  for (double& p : stop.places) p -= place;
  if (!stop.object_motion.empty()) stop.object_motion.resize(size);
  return stop;
}

void AddObjectMotion(const std::vector<double>& times, const std::vector<Pose>& X_LO,
                     const Vector3d& place, const Vector3d& direction, TouchSamples& samples) {
  samples.object_motion.clear();
  size_t at = 0;
  double moved = 0.0;
  const Pose* before = nullptr;
  for (const double time : samples.times) {
    // Of averaged neighbours the one next to their middle.
    while (at + 1 < times.size() && times[at] < time - kTick) ++at;
    const Pose* now = &X_LO[at];
    if (now->translation().hasNaN()) now = before;
    if (before != nullptr && now != nullptr) {
      const Vector3d normal = 0.5 * (before->linear() + now->linear()) * direction;
      moved += normal.dot(*now * place - *before * place);
    }
    samples.object_motion.push_back(moved);
    before = now;
  }
}

Vector3d FindNormal(const SurfaceDistance& distance, const Vector3d& place) {
  constexpr double kStep = 1e-3;  // [m]
  Vector3d normal;
  for (int i = 0; i < 3; ++i) {
    const Vector3d step = kStep * Vector3d::Unit(i);
    normal[i] = distance(place + step) - distance(place - step);
  }
  return normal.normalized();
}

LateMotion FindLateMotion(const Trajectory& p_O, const Vector3d& place, const Hold& hold,
                          double noise, double touch, const Vector3d& approach) {
  constexpr double kLeast = 1.5e-3, kCertain = 6e-3;  // [m]
  constexpr double kLeastClear = 4.0;                 // SD of the noise
  constexpr double kGoingOn = 0.3;                    // of the way that is left
  const Way way = TakeWay(p_O, hold, noise);
  const Vector3d left = CalcMeanBetween(way, touch, touch + 0.04) - place;
  const Vector3d across = left - approach.dot(left) * approach;
  LateMotion late;
  late.from = left.normalized();
  late.way = left.norm();
  if (late.way > kCertain + kClear * way.noise) {
    late.share = 1.0;
  } else if (across.norm() > std::max(kLeast, kLeastClear * way.noise)) {
    const Vector3d before = CalcMeanBetween(way, touch - 0.06, touch - 0.02) - place;
    const bool is_going_on = across.dot(before - left) > kGoingOn * across.squaredNorm();
    late.share = is_going_on ? 0.5 : 0.18;
  }
  return late;
}

}  // namespace graspbench
