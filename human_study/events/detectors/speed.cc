#include "human_study/events/contact_detector.h"

namespace graspbench {
namespace {

EventTime FindBySpeed(const ContactEvidence& evidence, const DigitEvidence& digit,
                      const ContactOptions& options) {
  const std::string no_touch = FindNoTouch(evidence, digit, options);
  if (!no_touch.empty()) return MissingEvent(no_touch);
  const size_t first = FindSamples(digit.speed.times, evidence.begin, evidence.hold.time).first;
  auto hold = static_cast<size_t>(FindHoldSample(digit.speed, evidence.hold));
  // Noise may lift one sample of a resting tip over the threshold.
  const auto is_resting = [&](size_t i) {
    return digit.speed.IsValid(i) && digit.speed.At(i) < options.speed_threshold;
  };
  while (hold > first && !is_resting(hold)) --hold;
  return TraceBack(digit.speed, hold, first, options.speed_threshold, Side::kBelow, kMinApproach);
}

}  // namespace

ContactDetector MakeSpeedDetector() {
  return {"speed",
          "last fall of the fingertip's speed against the object below a fixed threshold; late or "
          "early with the speed of approach, because the filter smears the stop",
          "fingertip markers", FindBySpeed};
}

}  // namespace graspbench
