#pragma once
/** @file
Gaps in a trajectory: finds hidden ones and fills short ones.

Fingertip markers are lost just when the hand closes on the object, so a filled gap can introduce a
false contact. Filling is therefore limited in time, and every filled sample is marked. */

#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

enum class GapFilling {
  kLinear,  ///< straight line between the neighbours
  kCubic,   ///< cubic Hermite curve, with the velocities on both sides: smooth at the edges
};

struct GapReport {
  size_t num_filled_gaps = 0;
  size_t num_filled_samples = 0;
  size_t num_open_gaps = 0;     ///< gaps above the limit or at an end, left invalid
  double longest_filled = 0.0;  ///< [s], as longest_open
  double longest_open = 0.0;
};

/** Fills gaps of at most `max_duration` [s], counted from the last valid sample before to the first
after. Gaps at the ends are not filled. Measured samples are never changed. */
GapReport FillGaps(Trajectory& trajectory, double max_duration,
                   GapFilling filling = GapFilling::kCubic);

/** Fills gaps of `trajectory` with the help of a second marker on the same or the next segment.
Their difference is interpolated linearly, so the tip moves with its companion. Fills only where the
companion is visible; gaps longer than `max_duration` [s] and gaps at the ends are not filled.

Artificial gaps in the trajectory of a thumb tip with a companion on the next segment (DFKI
recording, 100 Hz, hand around a pillow) gave median largest errors of 0.9, 2.2 and 3.2 mm for 0.1,
0.2 and 0.3 s; linear filling gave 1.6, 4.4 and 7.8 mm.
@pre both have the same times. @returns the number of samples filled. */
size_t FillGapsAlong(Trajectory& trajectory, const Trajectory& companion, double max_duration);

/** Some trackers repeat the last position while a marker is hidden. Makes invalid every sample
whose coordinates equal the previous valid sample's exactly, in runs of at least `min_repeats`. A
resting marker with rounded coordinates is kept: it repeats, then moves by no more than the smallest
step of the track (for a run at the end, the step before it). A marker with noise never repeats.
@returns the number of samples made invalid. @pre min_repeats >= 1. */
size_t InvalidateFrozenSamples(Trajectory& trajectory, size_t min_repeats = 1);

// Single samples at implausible positions: reflections, mismatched rays.
/** Makes invalid every sample farther from the median of its two valid neighbours on each side,
component by component, than all of
  - 5 mm,
  - the displacement of 30 m/s^2, above a reaching hand's acceleration, between two samples,
  - eight times the median of this distance over the track, its noise.
At most three passes are made, until none is found, so that two spikes in a row are also removed. A
marker that jumps and stays there, and the edges of gaps, are not changed.
@returns the number of samples made invalid. */
size_t InvalidateSpikes(Trajectory& trajectory);

}  // namespace graspbench
