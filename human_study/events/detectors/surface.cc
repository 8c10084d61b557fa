#include <cmath>

#include "human_study/events/detectors/detector_list.h"

namespace graspbench {
namespace {

EventTime FindBySurface(const ContactEvidence& evidence, const DigitEvidence& digit,
                        const ContactOptions& options) {
  if (digit.distance.size() == 0) return MissingEvent("the object's pose or shape is not known");
  const std::string no_touch = FindNoTouch(evidence, digit, options);
  if (!no_touch.empty()) return MissingEvent(no_touch);
  ScalarCurve clearance = digit.distance;
  const double pad_offset =
      std::isnan(digit.track->pad_offset) ? digit.hold_distance : digit.track->pad_offset;
  clearance.values.array() -= pad_offset;

  const Arrival arrival = FindArrival(clearance, evidence, options.arrival_tolerance);
  EventTime event = arrival.event;
  AllowForSettling(arrival, event);
  return event;
}

}  // namespace

ContactDetector MakeSurfaceDetector() {
  return {"surface",
          "marker's distance from the object's surface less that of the hold (or a given pad "
          "offset): last fall below a tolerance, extrapolated to zero with the speed there; where "
          "the distance "
          "settles more slowly than that, the middle of the stretch in which the touch may lie",
          "fingertip markers, the object's pose and shape", FindBySurface};
}

}  // namespace graspbench
