#pragma once
/** @file
Holes in a trajectory: finding hidden ones, closing short ones.

Fingertips drop out exactly when the hand closes on the object, so a filled gap can invent a
contact. Filling is therefore limited in time, and every filled sample says that it is filled. */

#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

enum class GapFilling {
  kLinear,  ///< straight line between the neighbours
  kCubic,   ///< cubic Hermite curve with the velocities on both sides: no corner at the edges
};

struct GapReport {
  size_t num_filled_gaps = 0;
  size_t num_filled_samples = 0;
  size_t num_open_gaps = 0;     ///< longer than the limit, or at an end: left invalid
  double longest_filled = 0.0;  ///< [s], as longest_open
  double longest_open = 0.0;
};

/** Fills gaps of at most `max_duration` [s], counted from the last valid sample before to the first
after. Gaps at the ends stay. Measured samples are never changed. */
GapReport FillGaps(Trajectory& trajectory, double max_duration,
                   GapFilling filling = GapFilling::kCubic);

/** Fills gaps of `trajectory` along a second marker on the same segment or the next: their
difference is carried on in a straight line, so the tip moves as its companion does. Only where the
companion is seen; gaps longer than `max_duration` [s] and those at the ends stay.

On a thumb's tip with a companion one segment up (DFKI recording, 100 Hz, hand about a pillow), gaps
made in what was seen were filled with a largest error of 0.9, 2.2, 3.2 mm (median) for 0.1, 0.2,
0.3 s; straight lines: 1.6, 4.4, 7.8 mm.
@pre both have the same times. @returns the number of samples filled. */
size_t FillGapsAlong(Trajectory& trajectory, const Trajectory& companion, double max_duration);

/** Some trackers repeat the last position while a marker is hidden. Makes invalid every sample
whose coordinates equal the previous valid sample's exactly, in runs of at least `min_repeats`.
Kept is a marker at rest that was rounded: what repeats, then goes on by no more than the smallest
step that the track has (a run at the end: comes from there). A marker in noise never repeats.
@returns the number of samples made invalid. @pre min_repeats >= 1. */
size_t InvalidateFrozenSamples(Trajectory& trajectory, size_t min_repeats = 1);

// Single samples that a marker cannot have been at: reflections, swapped rays.
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
