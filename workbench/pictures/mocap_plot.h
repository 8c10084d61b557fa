#pragma once
/** @file
A page that shows a recording at a glance: where points are missing or filled, and the height and
speed of each point. A swapped marker or a gap during the grasp is then visible before the
analysis. */

#include <string>

#include "human_study/recording/recording.h"

namespace graspbench {

/** Makes a self-contained HTML page. Long recordings are drawn in 600 steps, with the maximum speed
and the mean height of each step. Points that are not positions are left out. Speed is the
unfiltered difference of neighbouring samples, so that noise is visible.
@throws Error(kFormat) when no point is a position, or the recording has no sampling rate. */
std::string MakeRecordingPage(const std::string& name, const Recording& recording);

}  // namespace graspbench
