#pragma once
/** @file
JSON through one door: keys keep their order, numbers are written shortest-exact, and what is
missing is null, never a plausible number. */

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/pose.h"

namespace graspbench {

using Json = nlohmann::ordered_json;

/** A number, or null when it is not finite. */
inline Json JsonNumber(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
/** A number, or NaN for null. */
inline double NumberFrom(const Json& json) {
  return json.is_null() ? std::nan("") : json.get<double>();
}

/** A whole number that fits. @throws Error(kFormat). */
inline int IntFrom(const Json& json) {
  const double value = json.is_number_integer() ? json.get<double>() : std::nan("");
  if (!(std::abs(value) <= std::numeric_limits<int>::max())) {
    throw Error(ErrorKind::kFormat, "expected a whole number");
  }
  return json.get<int>();
}

/** On one line, or indented; bytes that are not UTF-8 (in names of files) become U+FFFD. */
inline std::string FormatJson(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

inline Json JsonVector(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }
/** Any number of numbers: joint angles, a point of a search. */
inline Json JsonAngles(const Eigen::VectorXd& q) { return std::vector<double>(q.begin(), q.end()); }
inline Eigen::VectorXd AnglesFrom(const Json& json) {
  const auto values = json.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}
/** {"p_m": [x, y, z], "R": three rows}. A matrix, not a quaternion, so that reading gives the very
same pose. */
inline Json JsonPose(const Pose& X) {
  const Eigen::Matrix3d R = X.linear();
  return Json{{"p_m", JsonVector(X.translation())},
              {"R", {JsonVector(R.row(0)), JsonVector(R.row(1)), JsonVector(R.row(2))}}};
}
inline Eigen::Vector3d VectorFrom(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}
inline Pose PoseFrom(const Json& json) {
  Eigen::Matrix3d R;
  for (int row = 0; row < 3; ++row)
    R.row(row) = VectorFrom(json.at("R").at(static_cast<size_t>(row)));
  return MakePose(R, VectorFrom(json.at("p_m")));
}

}  // namespace graspbench
