#include <algorithm>
#include <cmath>

#include "human_study/events/detectors/detector_list.h"

namespace graspbench {
namespace {

using Column = Eigen::Index;

// A digit slows by about 1 m/s^2 before it touches. Over 50 ms this moves the breakpoint of a
// straight approach at 0.1 m/s by 2 ms; a parabola instead of the line would follow it, but lets
// the noise move the breakpoint by 10 ms.
constexpr double kApproach = 0.05;      // [s] of samples before the breakpoint
constexpr double kRest = 0.08;          // [s] after it
constexpr double kMaxShift = 0.06;      // [s] from the arrival: farther is another event
constexpr size_t kMinSide = 4;          // measured samples on either side
constexpr int kNumTries = 4;            // the window is moved to its own answer so often
constexpr double kSettled = 0.005;      // [s] .. until it moves less than this
constexpr double kStep = 0.001;         // [s] between the breakpoints tried
constexpr double kModel = 0.001;        // [s] SD of what the straight line makes of a curved way
constexpr double kMinExplained = 60.0;  // of the square sum, over the residual variance
constexpr const char* kNoBreakpoint = "the path has no breakpoint where it arrives";
constexpr const char* kTooFew = "too few measured samples before or after the contact";

struct Samples {
  std::vector<double> times;
  std::vector<double> places;  ///< along the direction of approach, 0 in the hold [m]
};

/** Sum of squared residuals of the best r + v max(0, tc - t). */
double CalcMisfit(const Samples& samples, double tc) {
  double u_sum = 0.0, uu_sum = 0.0, p_sum = 0.0, up_sum = 0.0, pp_sum = 0.0;
  for (size_t i = 0; i < samples.times.size(); ++i) {
    const double u = std::max(0.0, tc - samples.times[i]), p = samples.places[i];
    u_sum += u;
    uu_sum += u * u;
    p_sum += p;
    up_sum += u * p;
    pp_sum += p * p;
  }
  const auto n = static_cast<double>(samples.times.size());
  const double covariance = up_sum - u_sum * p_sum / n;
  const double spread = uu_sum - u_sum * u_sum / n;  // 0 when no sample lies before tc: all is rest
  const double explained = spread > 0.0 ? covariance * covariance / spread : 0.0;
  return pp_sum - p_sum * p_sum / n - explained;
}

/** Measured samples in the window. Filled ones are no evidence. */
Samples TakeSamples(const Trajectory& p_O, double begin, double end, const Eigen::Vector3d& place,
                    const Eigen::Vector3d& direction) {
  Samples samples;
  const SampleRun window = FindSamples(p_O.times, begin, end);
  for (size_t i = window.first; i < window.last; ++i) {
    if (p_O.states[i] != SampleState::kMeasured) continue;
    samples.times.push_back(p_O.times[i]);
    samples.places.push_back(direction.dot(p_O.p.col(static_cast<Column>(i)) - place));
  }
  return samples;
}

/** The breakpoint with the smallest misfit; missing when the samples show none. */
EventTime FitBreakpoint(const Samples& samples, double interval) {
  if (samples.times.size() < 2 * kMinSide) return MissingEvent(kTooFew);
  const double first = samples.times[kMinSide - 1];
  const double last = samples.times[samples.times.size() - kMinSide];
  double best = std::nan(""), smallest = std::numeric_limits<double>::infinity();
  const auto num_steps = static_cast<int>((last - first) / kStep);
  for (int k = 0; k <= num_steps; ++k) {
    const double misfit = CalcMisfit(samples, first + k * kStep);
    if (misfit >= smallest) continue;
    smallest = misfit;
    best = first + k * kStep;
  }
  EventTime event;
  event.time = best;
  // Near its minimum the misfit is a parabola with a kink at every sample: look a frame away.
  const double h = std::max(interval, kStep);
  const double before = CalcMisfit(samples, best - h), after = CalcMisfit(samples, best + h);
  const double bend = (before - 2 * smallest + after) / (h * h);
  if (!(bend > 0.0)) return MissingEvent(kNoBreakpoint);
  event.time += std::clamp((before - after) / (2 * h * bend), -h, h);
  const double residual = smallest / static_cast<double>(samples.times.size() - 4);
  const double explained = CalcMisfit(samples, samples.times.front()) - smallest;
  if (!(explained > kMinExplained * residual)) return MissingEvent(kNoBreakpoint);
  event.uncertainty =
      std::hypot(std::hypot(std::sqrt(2.0 * residual / bend), kModel), interval / std::sqrt(12.0));

  const auto next = std::lower_bound(samples.times.begin(), samples.times.end(), event.time);
  const double hidden = *next - *(next - 1);
  if (hidden > 1.5 * interval) {
    event.is_in_gap = true;
    event.uncertainty = std::hypot(event.uncertainty, hidden / std::sqrt(12.0));
  }
  return event;
}

/** Mean of the measured samples between two instants; NaN without any. */
Eigen::Vector3d CalcMeanPlace(const Trajectory& p_O, double begin, double end) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  const SampleRun window = FindSamples(p_O.times, begin, end);
  for (size_t i = window.first; i < window.last; ++i) {
    if (p_O.states[i] != SampleState::kMeasured) continue;
    sum += p_O.p.col(static_cast<Column>(i));
    count += 1.0;
  }
  return sum / count;
}

/** The fit about a guess, moved to its own answer until it stays. */
EventTime SettleBreakpoint(const Trajectory& p_O, double begin, double guess, double interval) {
  EventTime event;
  for (int i = 0; i < kNumTries; ++i) {
    const double first = std::max(begin, guess - kApproach), last = guess + kRest;
    const Eigen::Vector3d place = CalcMeanPlace(p_O, guess, last);
    const Eigen::Vector3d direction = CalcMeanPlace(p_O, first, guess) - place;
    if (!direction.allFinite()) return MissingEvent(kTooFew);
    event = FitBreakpoint(TakeSamples(p_O, first, last, place, direction.normalized()), interval);
    if (!event.IsFound() || std::abs(event.time - guess) < kSettled) break;
    guess = event.time;
  }
  return event;
}

EventTime FindByBreakpoint(const ContactEvidence& evidence, const DigitEvidence& digit,
                           const ContactOptions& options) {
  const std::string no_touch = FindNoTouch(evidence, digit, options);
  if (!no_touch.empty()) return MissingEvent(no_touch);
  const Arrival arrival = FindArrival(digit.departure, evidence, options.arrival_tolerance);
  if (!arrival.event.IsFound()) return arrival.event;
  EventTime event =
      SettleBreakpoint(digit.p_O, evidence.begin, arrival.event.time, digit.speed.Interval());
  // Where the path shows no breakpoint, or is hidden, what is left is the less certain arrival.
  const bool is_near = std::abs(event.time - arrival.event.time) < kMaxShift;
  if (!event.IsFound() || !is_near) event = arrival.event;
  AllowForSettling(arrival, event);
  return event;
}

}  // namespace

ContactDetector MakeBreakpointDetector() {
  return {
      "breakpoint",
      "least-squares fit of a straight approach and rest to the unfiltered path against the "
      "object, along the direction of approach, from 50 ms before to 80 ms after; filled samples "
      "take no part; where the path shows no breakpoint, its arrival at its place in the hold",
      "fingertip markers", FindByBreakpoint};
}

}  // namespace graspbench
