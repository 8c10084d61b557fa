#include "human_study/events/contact_detector.h"

namespace graspbench {
namespace {

EventTime FindByBreakpoint(const ContactEvidence& evidence, const DigitEvidence& digit,
                           const ContactOptions& options) {
  const std::string no_touch = FindNoTouch(evidence, digit, options);
  if (!no_touch.empty()) return MissingEvent(no_touch);
  return MakeTouchEvent(digit, digit.fits.path, options);
}

}  // namespace

ContactDetector MakeBreakpointDetector() {
  return {"breakpoint",
          "where the unfiltered path to the place in the hold, along its direction of approach, "
          "breaks from approach to rest: mean over all breaks and depths of settling, weighed by "
          "how well they explain the samples; filled samples take no part",
          "fingertip markers", FindByBreakpoint};
}

}  // namespace graspbench
