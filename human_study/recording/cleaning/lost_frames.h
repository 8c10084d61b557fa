#pragma once
/** @file
Finds frames that a recording lacks although its time stamps are even: dropped by a camera, a
network or an export that continued the count or spaced its stamps evenly. All times after a loss
are wrong.

Where n frames are missing, all markers advance by n additional steps of their own. Between frames
i-1 and i, marker m moves by (1 + n) v_m, where v_m is its motion per frame, from the frames on both
sides. Over all markers, weighted by their noise s_m,

    n = sum(v_m . (d_m - v_m) / s_m^2) / sum(v_m^2 / s_m^2),   SE = 1 / sqrt(sum(v_m^2 / s_m^2)).

Losses are only detected while several markers move: frames lost at rest leave no trace. */

#include <vector>

#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

struct FrameLoss {
  size_t sample = 0;   ///< first sample after the loss
  double count = 0.0;  ///< estimated number of frames; not an integer
};

/** Finds losses. @param tracks  with one clock; filled samples are ignored.
@returns losses in the order of time; none for fewer than three tracks. */
std::vector<FrameLoss> FindFrameLosses(const std::vector<const Trajectory*>& tracks);

}  // namespace graspbench
