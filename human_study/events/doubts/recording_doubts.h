#pragma once
/** @file
One more doubt of plausibility.h, about what a marker stands for.

  object_left_behind: in the grip of the hold, or without one of the recording's end, the digits rise
    together by 30 mm (or plausibility.min_carried_m, if that is less), and the recorded object
    stays: its marker is not on what the hand carries. One of four digits or more may move. */

#include <vector>

#include "human_study/events/doubts/plausibility.h"

namespace graspbench {

/** @param tips  filtered. @param travel  of the object, which was recorded and not lifted. */
std::vector<Doubt> FindLeftBehind(const std::vector<SmoothPath>& tips, const ObjectTravel& travel,
                                  const Hold& hold, const LiftOffOptions& lift_off,
                                  const PlausibilityOptions& options);

}  // namespace graspbench
