#include <algorithm>
#include <cmath>

#include "human_study/events/contact_detector.h"
#include "human_study/recording/cleaning/butterworth.h"
#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {
namespace {

using Column = Eigen::Index;

constexpr double kCutoff = 50.0;     // [Hz], or what the sensor's rate allows
constexpr double kAfterHold = 0.5;   // [s] the grip's force has its peak by then
constexpr double kPeakShare = 0.25;  // the search starts at a quarter of the peak
constexpr size_t kMinBaseline = 20;  // samples before the movement

/** Rate of change of the filtered force. */
ScalarCurve CalcForceRate(const ForceChannel& force, double cutoff, double rate) {
  const Eigen::VectorXd raw = Eigen::Map<const Eigen::VectorXd>(
      force.values.data(), static_cast<Column>(force.values.size()));
  const Eigen::VectorXd smooth = FilterZeroPhase(MakeLowPass(cutoff, rate), raw);
  ScalarCurve curve;
  curve.times = force.times;
  curve.states.assign(force.times.size(), SampleState::kMeasured);
  curve.values.resize(smooth.size());
  for (Column i = 0; i < smooth.size(); ++i) {
    const Column before = std::max<Column>(i - 1, 0), after = std::min(i + 1, smooth.size() - 1);
    curve.values[i] =
        (smooth[after] - smooth[before]) / (static_cast<double>(after - before) / rate);
  }
  curve.reach = 0.18 / cutoff;
  return curve;
}

/** 0 for an open switch and 1 for a closed one, open being what it is before the movement; empty
when the channel is no switch: it has other values than two, or both of them before the movement.
*/
Eigen::VectorXd ReadSwitch(const ForceChannel& force, const SampleRun& baseline) {
  constexpr double kLevel = 0.1;  // of the range: how far samples of a level may lie from it
  const auto [low, high] = std::minmax_element(force.values.begin(), force.values.end());
  const double range = *high - *low;
  if (!(range > 0.0)) return {};
  const bool is_open_high = force.values[baseline.first] > *low + range / 2.0;
  Eigen::VectorXd closed(static_cast<Column>(force.values.size()));
  for (size_t i = 0; i < force.values.size(); ++i) {
    const double share = (force.values[i] - *low) / range;
    if (!(share < kLevel || share > 1.0 - kLevel)) return {};
    closed[static_cast<Column>(i)] = (share > 0.5) != is_open_high ? 1.0 : 0.0;
    if (i >= baseline.first && i < baseline.last && closed[static_cast<Column>(i)] > 0.0) return {};
  }
  return closed;
}

/** When a switch closed for good before the hold; openings of less than kBounce are bounces. */
EventTime FindClosing(const ForceChannel& force, const Eigen::VectorXd& closed, size_t first,
                      double hold) {
  constexpr double kBounce = 0.01;  // [s]
  ScalarCurve curve;
  curve.times = force.times;
  curve.states.assign(force.times.size(), SampleState::kMeasured);
  curve.values = closed;
  const SampleRun until_hold = FindSamples(force.times, force.times.front(), hold);
  if (until_hold.size() == 0 || closed[static_cast<Column>(until_hold.last) - 1] == 0.0) {
    return MissingEvent("the touch switch is open in the hold");
  }
  return TraceBack(curve, until_hold.last - 1, first, 0.5, Side::kAbove, kBounce);
}

EventTime FindByForce(const ContactEvidence& evidence, const DigitEvidence& digit,
                      const ContactOptions& options) {
  const ForceChannel& force = digit.track->force;
  if (force.times.empty()) return MissingEvent("the digit has no force sensor");
  const SampleRun baseline = FindSamples(force.times, force.times.front(), evidence.begin);
  const SampleRun grip = FindSamples(force.times, evidence.begin, evidence.hold.time + kAfterHold);
  if (baseline.size() < kMinBaseline || grip.size() < kMinBaseline) {
    return MissingEvent("too few samples of force before or after the onset");
  }
  if (!FindSampling(force.times).is_even) {
    return MissingEvent("the samples of force are not evenly spaced");
  }
  const double rate =
      static_cast<double>(force.times.size() - 1) / (force.times.back() - force.times.front());
  const Eigen::VectorXd closed = ReadSwitch(force, baseline);
  if (closed.size() > 0) return FindClosing(force, closed, grip.first, evidence.hold.time);
  ScalarCurve curve = CalcForceRate(force, std::min(kCutoff, 0.3 * rate), rate);

  const auto rest = curve.values.segment(static_cast<Column>(baseline.first),
                                         static_cast<Column>(baseline.size()));
  curve.noise = std::sqrt((rest.array() - rest.mean()).square().mean());
  const double threshold = rest.mean() + options.force_noise_factor * curve.noise;
  double zero = 0.0;
  for (size_t i = baseline.first; i < baseline.last; ++i) zero += force.values[i];
  zero /= static_cast<double>(baseline.size());
  const auto first = force.values.begin() + static_cast<std::ptrdiff_t>(grip.first);
  const auto last = force.values.begin() + static_cast<std::ptrdiff_t>(grip.last);
  const double start = zero + kPeakShare * (*std::max_element(first, last) - zero);
  const auto quarter = std::find_if(first, last, [&](double f) { return f >= start; });
  if (quarter == last) return MissingEvent("the force does not rise out of its noise");
  EventTime event = TraceBack(curve, static_cast<size_t>(quarter - force.values.begin()),
                              grip.first, threshold, Side::kAbove);
  if (!event.IsFound()) return MissingEvent("the force does not rise out of its noise");
  // A threshold near the noise sees a sudden rise as early as the filter smears it.
  event.uncertainty = std::hypot(event.uncertainty, curve.reach / std::sqrt(3.0));
  return event;
}

}  // namespace

ContactDetector MakeForceDetector() {
  return {
      "force",
      "rate of force above the baseline's mean plus four standard deviations, traced back from "
      "a quarter of the peak (after Luciw et al. 2014); of a touch switch, whose channel has two "
      "levels, the instant from which it stays closed",
      "a force or tactile sensor or a touch switch of the digit", FindByForce};
}

}  // namespace graspbench
