#pragma once
/** @file
Numbers of grasp files: poses, written as a position and a quaternion, and lists out of JSON, whose
messages name file and place ("pose[3]"). */

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/pose.h"
#include "core/base/text/json.h"

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

/** @throws Error(kFormat) with line and column where it is no JSON, and where it is no object. */
Json ParseJsonObject(std::string_view bytes, const std::string& file);

/** Value of a key. @throws Error(kFormat) when it is missing. */
const Json& GetJson(const Json& object, const std::string& key, const std::string& file);

/** A list of `size` finite numbers; of any size with 0. @param where  "grasps.json: pose[3]".
@throws Error(kFormat). */
std::vector<double> ReadJsonNumbers(const Json& json, const std::string& where, size_t size = 0);

/** One verdict for each of `size` grasps: truth values, or 0 and 1. @throws Error(kFormat). */
std::vector<bool> ReadJsonLabels(const Json& json, const std::string& where, size_t size);

}  // namespace graspbench
