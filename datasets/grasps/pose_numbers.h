#pragma once
/** @file
Reads the numbers of grasp files: poses as position and quaternion, and JSON lists. Messages name
file and location ("pose[3]"). */

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/pose.h"
#include "core/base/text/json.h"

namespace graspbench {

/** Tolerance of a quaternion's norm (float32 and rounding); quaternions are normalised. */
inline constexpr double kQuaternionTolerance = 1e-3;

/** Converts x y z [m] and a quaternion w x y z to a settled pose. @param where  location, for
messages.
@throws Error(kRange) for a quaternion whose norm is not 1 within the tolerance. */
Pose PoseFromNumbers(const double* numbers, const std::string& where);

/** Inverse of PoseFromNumbers, for the settled pose; the largest number of w x y z is positive. */
std::array<double, 7> NumbersFromPose(const Pose& X);

/** Rotates the pose by at most some 1e-14 rad, so that it is bitwise equal after writing and
reading it as seven numbers: three numbers of its quaternion are multiples of 2^-46, and the fourth,
a largest one, follows from them. */
Pose SettlePose(const Pose& X);

/** Parses a JSON object. @throws Error(kFormat) with line and column for invalid JSON, and for a
value that is not an object. */
Json ParseJsonObject(std::string_view bytes, const std::string& file);

/** Returns the value of a key. @throws Error(kFormat) when it is missing. */
const Json& GetJson(const Json& object, const std::string& key, const std::string& file);

/** Reads a list of `size` finite numbers, or of any length if `size` is 0. @param where
"grasps.json: pose[3]".
@throws Error(kFormat). */
std::vector<double> ReadJsonNumbers(const Json& json, const std::string& where, size_t size = 0);

/** Reads a verdict for each of `size` grasps, as Booleans or as 0 and 1. @throws Error(kFormat). */
std::vector<bool> ReadJsonLabels(const Json& json, const std::string& where, size_t size);

}  // namespace graspbench
