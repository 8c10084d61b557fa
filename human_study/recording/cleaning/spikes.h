#pragma once
/** @file
Single samples that a marker cannot have been at: reflections, swapped rays. */

#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

/** Makes invalid every sample farther from the median of its two valid neighbours on each side, axis
by axis, than all of
  - 5 mm,
  - what 30 m/s^2 does between two samples, more than a reaching hand's acceleration,
  - eight times the track's usual distance (median), its noise.
Passes are repeated until none is found, at most three, so that two in a row go, too. A marker that
jumps and stays, and edges of gaps, are left alone.
@returns the number of samples made invalid. */
size_t InvalidateSpikes(Trajectory& trajectory);

}  // namespace graspbench
