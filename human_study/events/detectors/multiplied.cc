#include <algorithm>

#include "human_study/events/contact_detector.h"

namespace graspbench {
namespace {

using Column = Eigen::Index;

constexpr double kNear = 0.002;     // [m] from its place in the hold: as good as there
constexpr double kFar = 0.02;       // [m] not near any more
constexpr double kMovedFar = 0.02;  // [m] an object this far from its place speaks against

/** 1 up to `good`, 0 from `bad` on, linear between. */
double CalcCriterion(double value, double good, double bad) {
  return std::clamp((bad - value) / (bad - good), 0.0, 1.0);
}

EventTime FindByProduct(const ContactEvidence& evidence, const DigitEvidence& digit,
                        const ContactOptions& options) {
  const std::string no_touch = FindNoTouch(evidence, digit, options);
  if (!no_touch.empty()) return MissingEvent(no_touch);
  const SampleRun reach = FindSamples(evidence.opening.times, evidence.begin, evidence.hold.time);
  const int widest = FindPeak(evidence.opening, reach);
  if (widest < 0) return MissingEvent("the opening is not seen during the movement");
  const SampleRun closing{static_cast<size_t>(widest), reach.last};
  if (closing.size() < 3) return MissingEvent("the hand does not close before the hold");
  const double begin = evidence.opening.times[closing.first];

  ScalarCurve product = Cut(digit.speed, closing);
  for (size_t i = closing.first; i < closing.last; ++i) {
    const auto column = static_cast<Column>(i);
    const double is_slow = CalcCriterion(digit.speed.values[column], 0.5 * options.speed_threshold,
                                         1.5 * options.speed_threshold);
    const double is_near = CalcCriterion(digit.departure.values[column], kNear, kFar);
    const double is_early = CalcCriterion(digit.speed.times[i], begin, evidence.hold.time);
    double is_unmoved = 1.0;
    if (evidence.object_displacement.size() > 0) {
      is_unmoved = CalcCriterion(evidence.object_displacement.values[column], 0.0, kMovedFar);
    }
    product.At(i - closing.first) = is_slow * is_near * is_early * is_unmoved;
  }
  return FindProductPeak(product);
}

}  // namespace

ContactDetector MakeMultipliedDetector() {
  return {"multiplied",
          "after the widest opening, the largest product of four criteria between 0 and 1: slow "
          "against the object, near its place in the hold, early, object not yet moved (after "
          "Schot, Brenner and Smeets 2010)",
          "fingertip markers", FindByProduct};
}

}  // namespace graspbench
