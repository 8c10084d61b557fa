#pragma once
/** @file
The last stretch of a fingertip's way to where it holds, as samples in one dimension for
touch_fit.h. Only measured samples of the unfiltered path take part. */

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "core/base/pose.h"
#include "human_study/events/hold.h"
#include "human_study/events/reach_trial.h"
#include "human_study/events/touch_fit.h"
#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

/** Where a tip is about the hold: mean of its measured samples from 50 ms before to 100 ms
after it, those far off left out, or, when hidden there, of the 10 nearest in the hold; NaN without
any. */
Eigen::Vector3d FindHoldPlace(const Trajectory& p_O, const Hold& hold);

/** Clearance from the surface less that at the place of the hold. The touch is looked for from
where it was last farther than 5 mm (or six standard deviations of the noise), because no skin
yields more, or farther than 25 mm from its place, to where it has come to rest.
@param place  of the hold, in O.
@param noise  SD of a coordinate [m].
@param pad_offset  of the marker at the touch [m]; NaN: not known.
@return no times when no such stretch is seen. */
TouchSamples TakeApproachToSurface(const Trajectory& p_O, const SurfaceDistance& distance,
                                   const Eigen::Vector3d& place, const Hold& hold, double noise,
                                   double pad_offset);

/** TouchSamples::object_motion: how far the object's point `place` has gone along `direction`, step
by step as the object turns; `direction` is fixed in O.
@param X_LO  of every sample of `times`, known at the samples of the touch. */
void AddObjectMotion(const std::vector<double>& times, const std::vector<Pose>& X_LO,
                     const Eigen::Vector3d& place, const Eigen::Vector3d& direction,
                     TouchSamples& samples);
/** Outward normal of the surface nearest to a place, unit, by differences over 1 mm. */
Eigen::Vector3d FindNormal(const SurfaceDistance& distance, const Eigen::Vector3d& place);

/** The same along the direction in which it came from about 8 mm to about 4 mm of its place (farther
where noise demands it), and nearer than 25 mm to it.
@param from  another direction to begin with, from the place outward, unit; NaN: that one.
@param after  no touch is looked for earlier [s]. */
TouchSamples TakeApproachToPlace(
    const Trajectory& p_O, const Eigen::Vector3d& place, const Hold& hold, double noise,
    const Eigen::Vector3d& from = Eigen::Vector3d::Constant(std::nan("")),
    double after = -std::numeric_limits<double>::infinity());

/** Skin that has touched sinks in again when the grip is built up, so that the last stop is not the
touch: a tip that came fast and stopped at once within 4 mm of its place, and only crept from there,
touched where it stopped.
@param touch  the instant believed so far [s].
@return what was seen until just after that stop, its places counted from there; no times when there
is no such stop 40 ms or more before `touch`. */
TouchSamples TakeEarlierStop(const TouchSamples& samples, double touch);

/** What a tip still does just after an instant at which it is said to have touched. A path that
turns stops in one direction before it stops in the other, and the touch is the last stop; but a
phalanx that turns on its pad moves its marker, too, and without a shape nothing tells them apart. */
struct LateMotion {
  Eigen::Vector3d from;  ///< where it still is, from its place in the hold, unit
  double way = 0.0;      ///< how far that is [m]
  /** How likely it has not touched yet. 1: it is farther than a phalanx turns. 0.5: it goes on
  across the approach, clear of the noise, as it did before. 0.18: it does so from the touch on; half
  of that would leave an error of three standard deviations unsaid. */
  double share = 0.0;
};
/** @param approach  direction of the clearance at that instant, unit. */
LateMotion FindLateMotion(const Trajectory& p_O, const Eigen::Vector3d& place, const Hold& hold,
                          double noise, double touch, const Eigen::Vector3d& approach);

}  // namespace graspbench
