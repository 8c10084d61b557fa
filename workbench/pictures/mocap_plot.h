#pragma once
/** @file
A page that shows a recording at a glance: where points are missing or filled, and the height and
speed of each, so that a swapped marker or a hole in the grasp is seen before anything is computed.
*/

#include <string>

#include "human_study/recording/recording.h"

namespace graspbench {

/** A self-contained HTML page. Long recordings are drawn in 600 steps: the highest speed and the
mean height of each. Points that are no positions are left out. Speed is that of neighbouring
samples, not filtered: noise is to be seen.
@throws Error(kFormat) when no point is a position or the recording states no rate. */
std::string MakeRecordingPage(const std::string& name, const Recording& recording);

}  // namespace graspbench
