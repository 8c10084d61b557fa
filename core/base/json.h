#pragma once
/** @file
JSON through one door: keys keep their order, numbers are written shortest-exact, and what is
missing is null, never a plausible number. */

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/pose.h"

namespace graspbench {

using Json = nlohmann::ordered_json;

/** A number, or null when it is not finite. */
inline Json JsonNumber(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
/** A number, or NaN for null. */
inline double NumberFrom(const Json& json) {
  return json.is_null() ? std::nan("") : json.get<double>();
}

inline Json JsonVector(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }
/** {"p_m": [x, y, z], "q_wxyz": [w, x, y, z]}. */
inline Json JsonPose(const Pose& X) {
  const Eigen::Quaterniond q(X.linear());
  return Json{{"p_m", JsonVector(X.translation())},
              {"q_wxyz", Json::array({q.w(), q.x(), q.y(), q.z()})}};
}
inline Eigen::Vector3d VectorFrom(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}
inline Pose PoseFrom(const Json& json) {
  const Json& q = json.at("q_wxyz");
  return MakePose(Eigen::Quaterniond(q.at(0).get<double>(), q.at(1).get<double>(),
                                     q.at(2).get<double>(), q.at(3).get<double>())
                      .normalized()
                      .toRotationMatrix(),
                  VectorFrom(json.at("p_m")));
}

}  // namespace graspbench
