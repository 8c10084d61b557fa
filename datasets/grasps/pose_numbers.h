#pragma once
/** @file
Poses as grasp files write them: a position and a quaternion, as seven numbers. */

#include <array>
#include <string>

#include "core/base/pose.h"

namespace graspbench {

/** A quaternion's length may differ from 1 by this much (float32 and rounding); it is made 1. */
inline constexpr double kQuaternionTolerance = 1e-3;

/** x y z [m], quaternion w x y z. @param where  of the numbers, for messages.
@throws Error(kRange) for a quaternion that is none; the result is a settled pose. */
Pose PoseFromNumbers(const double* numbers, const std::string& where);

/** The other way, of the settled pose: its largest number of w x y z is positive. */
std::array<double, 7> NumbersFromPose(const Pose& X);

/** The pose, turned by at most some 1e-14 rad, so that it comes back bit by bit when it is written
as seven numbers and read again: three numbers of its quaternion are multiples of 2^-46, the fourth,
a largest one, follows from them. */
Pose SettlePose(const Pose& X);

}  // namespace graspbench
