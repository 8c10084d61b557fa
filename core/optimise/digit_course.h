#pragma once
/** @file
The way of one digit to the object at rest, by geometry alone.

A trial disturbs what it measures: the digit that comes first pushes the object towards the others,
so it tells when a digit met an object on its way, not when it would have met the object where it
stood. Here the object stands still, and the joints follow the closing law but for a deviation that
does not change on the way: lag, sag and what neighbouring fingers hold back, as a trial showed it
at the digit's first touch. */

#include <Eigen/Core>

#include "core/base/units.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

struct DigitCourse {
  double touch = kUnset;  ///< the first s at which the digit is at the object; NaN: at none
  double lowest = 0.0;    ///< lowest point of the digit on its way there, above the table [m]
};

/** @param q_pre  the course is q_pre + s (grasp.q_target - q_pre), coupled joints filled in
(num_joints) [rad].
@param deviation  added to it (num_joints) [rad].  @pre the grasp brings its placement. */
DigitCourse CalcDigitCourse(const Hand& hand, const GraspObject& object, const Grasp& grasp,
                            const Digit& digit, const Eigen::VectorXd& q_pre,
                            const Eigen::VectorXd& deviation);

}  // namespace graspbench
