#include "human_study/events/peak_opening.h"

#include <algorithm>
#include <cmath>

namespace graspbench {
namespace {

using Column = Eigen::Index;

/** Top of the parabola through a sample and its neighbours. */
EventTime RefinePeak(const ScalarCurve& curve, size_t peak, double& value) {
  EventTime event;
  event.time = curve.times[peak];
  event.uncertainty = curve.Interval() / std::sqrt(12.0);
  event.is_filled = HasFilledNear(curve, event.time);
  value = curve.values[static_cast<Column>(peak)];
  if (peak == 0 || peak + 1 >= curve.size() || !curve.IsValid(peak - 1) ||
      !curve.IsValid(peak + 1)) {
    event.is_in_gap = true;
    return event;
  }
  const double before = curve.values[static_cast<Column>(peak - 1)];
  const double after = curve.values[static_cast<Column>(peak + 1)];
  const double bend = before - 2 * value + after;  // curvature * interval^2
  if (!(bend < 0.0)) return event;
  const double shift = std::clamp((before - after) / (2 * bend), -0.5, 0.5);
  event.time += shift * curve.Interval();
  value -= 0.25 * (before - after) * shift;
  const double curvature = bend / (curve.Interval() * curve.Interval());
  event.uncertainty = std::hypot(event.uncertainty, curve.rate_noise / curvature);
  return event;
}

/** Going back from the end, the highest sample before the curve has fallen by `min_prominence`. */
int FindLastPeak(const ScalarCurve& curve, const SampleRun& samples, double min_prominence) {
  int peak = -1;
  for (size_t i = samples.last; i-- > samples.first;) {
    if (!curve.IsValid(i)) continue;
    const double value = curve.values[static_cast<Column>(i)];
    if (peak < 0 || value > curve.values[peak]) {
      peak = static_cast<int>(i);
    } else if (value < curve.values[peak] - min_prominence) {
      break;
    }
  }
  return peak;
}

}  // namespace

PeakOpening FindPeakOpening(const ScalarCurve& opening, double begin, double first_contact,
                            double end, double min_prominence) {
  PeakOpening result;
  const int largest = FindPeak(opening, FindSamples(opening.times, begin, end));
  const double last_end = std::isnan(first_contact) ? end : first_contact;
  const int last =
      FindLastPeak(opening, FindSamples(opening.times, begin, last_end), min_prominence);
  if (largest < 0 || last < 0) {
    result.largest = result.last = MissingEvent("the opening is not seen during the movement");
    return result;
  }
  result.largest = RefinePeak(opening, static_cast<size_t>(largest), result.largest_value);
  result.last = RefinePeak(opening, static_cast<size_t>(last), result.last_value);
  result.is_ambiguous = largest != last;
  return result;
}

}  // namespace graspbench
