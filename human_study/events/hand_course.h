#pragma once
/** @file
What the hand does as a whole while it reaches: how its tips lie to each other, where its digits
go, and how it turns.

    plane    the tips' distance from one plane (core/grasp/pad_geometry.h), four digits or more
    meeting  distance of the digits' courses from one point; a course is the tip's velocity against
             the wrist, so that transport takes no part
    axis     the opposition axis (Paulignan et al. 1997): unit vector from the thumb's tip to the
             mean of the other tips

The axis stands for the hand's orientation, the third component of a reach beside transport and
grasp. A turn about the axis itself is not seen. The wrist may turn without moving: then it adds
the same turn to all courses, which the meeting residual contains. */

#include <Eigen/Core>

#include "core/base/units.h"
#include "human_study/events/filtered_trial.h"
#include "human_study/events/scalar_curve.h"

namespace graspbench {

struct HandCourse {
  ScalarCurve plane;  ///< [m]; invalid throughout with fewer than four digits
  /** [m]; invalid where a tip is no faster against the wrist than four SD of its noise, and
  throughout where no wrist was recorded. */
  ScalarCurve meeting;
  Eigen::Matrix3Xd axis;  ///< in L, a column a sample; NaN where a tip is hidden
};

/** @param cutoff  of tips and wrist [Hz]. @throws Error(kRange) when it does not fit the rate. */
HandCourse CalcHandCourse(FilteredTrial& trial, double cutoff);

/** Angle within which the axis counts as settled [rad]. */
inline constexpr double kSettledAngle = RadFromDeg(5.0);

/** How far the axis turns from one instant to another [rad]; NaN where one is not seen. */
double CalcAxisTurn(const HandCourse& course, double from, double to);

/** From when on the axis stays within kSettledAngle of where it is at `end`; `begin` where it never
was farther away; NaN where it is not seen at `end`.
@param begin,end  [s] on the trial's clock. */
double FindAxisSettling(const HandCourse& course, double begin, double end);

/** Median of the meeting residual between two instants [m]; NaN without a valid sample. */
double CalcMedianMeeting(const HandCourse& course, double from, double to);

}  // namespace graspbench
