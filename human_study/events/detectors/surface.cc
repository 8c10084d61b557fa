#include "human_study/events/contact_detector.h"

namespace graspbench {
namespace {

EventTime FindBySurface(const ContactEvidence& evidence, const DigitEvidence& digit,
                        const ContactOptions& options) {
  if (digit.distance.size() == 0) return MissingEvent("the object's pose or shape is not known");
  const std::string no_touch = FindNoTouch(evidence, digit, options);
  if (!no_touch.empty()) return MissingEvent(no_touch);
  return MakeTouchEvent(digit, digit.fits.surface, options);
}

}  // namespace

ContactDetector MakeSurfaceDetector() {
  return {"surface",
          "where the marker's unfiltered distance from the object's surface breaks from approach "
          "to rest: mean over all breaks and depths of settling, weighed by how well they explain "
          "the samples; a given pad offset takes part, filled samples do not",
          "fingertip markers, the object's pose and shape", FindBySurface};
}

}  // namespace graspbench
