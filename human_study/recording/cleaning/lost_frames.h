#pragma once
/** @file
Frames that a recording lacks although its time stamps are even: dropped by a camera, a network or an
export that then counted on, or spread its stamps evenly. Every instant after one is early or late.

Where frames are missing all markers go on by the same number of their own steps. Between frames i-1
and i marker m moves by (1 + n) v_m, with v_m its motion a frame, from the frames on both sides. Over
all markers, weighted by their noise s_m,

    n = sum(v_m . (d_m - v_m) / s_m^2) / sum(v_m^2 / s_m^2),   SE = 1 / sqrt(sum(v_m^2 / s_m^2)).

Seen only while several markers move: frames lost at rest leave no trace. */

#include <vector>

#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

struct FrameLoss {
  size_t sample = 0;   ///< the first one after it
  double count = 0.0;  ///< of frames; not whole
};

/** @param tracks  of one clock. Filled samples say nothing.
@returns in the order of time; none for fewer than three tracks. */
std::vector<FrameLoss> FindFrameLosses(const std::vector<const Trajectory*>& tracks);

}  // namespace graspbench
