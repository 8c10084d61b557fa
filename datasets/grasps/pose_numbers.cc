#include "datasets/grasps/pose_numbers.h"

#include <fmt/core.h>

#include <cmath>

#include "core/base/error.h"
#include "datasets/journal/checked_line.h"

namespace graspbench {

Json ParseJsonObject(std::string_view bytes, const std::string& file) {
  Json json;
  try {
    json = Json::parse(bytes);
  } catch (const Json::exception& fault) {
    throw Error(ErrorKind::kFormat, file + " cannot be used: " + DescribeJsonFault(fault));
  }
  if (!json.is_object()) {
    throw Error(ErrorKind::kFormat, file + " holds no JSON object; expected {..}");
  }
  return json;
}

const Json& GetJson(const Json& object, const std::string& key, const std::string& file) {
  const Json* const found = object.find(key);
  if (found == nullptr) {
    throw Error(ErrorKind::kFormat, file + ": the key \"" + key + "\" is missing");
  }
  return *found;
}

std::vector<double> ReadJsonNumbers(const Json& json, const std::string& where, size_t size) {
  if (!json.is_array() || (size > 0 && json.size() != size)) {
    throw Error(ErrorKind::kFormat,
                where +
                    (size == 0 ? ": expected a list of numbers"
                               : fmt::format(": expected a list of {} numbers", size)) +
                    (json.is_array() ? fmt::format(", there are {}", json.size()) : ""));
  }
  std::vector<double> numbers;
  for (const Json& number : json) {
    numbers.push_back(number.is_number() ? number.get<double>() : std::nan(""));
    if (!std::isfinite(numbers.back())) {
      throw Error(ErrorKind::kFormat,
                  fmt::format("{}[{}]: expected a finite number", where, numbers.size() - 1));
    }
  }
  return numbers;
}

std::vector<bool> ReadJsonLabels(const Json& json, const std::string& where, size_t size) {
  if (!json.is_array() || json.size() != size) {
    throw Error(ErrorKind::kFormat,
                fmt::format("{}: expected a list of {} verdicts, one for each grasp", where, size));
  }
  std::vector<bool> labels;
  for (const Json& label : json) {
    const double number = label.is_boolean()  ? (label.get<bool>() ? 1.0 : 0.0)
                          : label.is_number() ? label.get<double>()
                                              : std::nan("");
    if (number != 0.0 && number != 1.0) {
      throw Error(ErrorKind::kFormat,
                  fmt::format("{}[{}]: expected true, false, 1 or 0", where, labels.size()));
    }
    labels.push_back(number == 1.0);
  }
  return labels;
}

namespace {

/** Far above the rounding of a quaternion that is taken out of a matrix, far below what matters. */
constexpr double kGrid = 0x1p-46;
/** Numbers that differ by less count as equally large: rounding must not choose among them. */
constexpr double kSameSize = 1e-9;

/** w x y z of the settled rotation. */
Eigen::Vector4d SettleQuaternion(Eigen::Vector4d q) {
  q.normalize();
  Eigen::Index largest = 0;
  while (std::abs(q[largest]) < q.cwiseAbs().maxCoeff() - kSameSize) ++largest;
  if (q[largest] < 0.0) q = -q;
  double rest = 1.0;
  for (Eigen::Index i = 0; i < 4; ++i) {
    if (i == largest) continue;
    q[i] = std::round(q[i] / kGrid) * kGrid + 0.0;
    rest -= q[i] * q[i];
  }
  q[largest] = std::sqrt(rest);
  return q;
}

Pose MakeSettledPose(const Eigen::Vector4d& q, const Eigen::Vector3d& p) {
  const Eigen::Vector4d settled = SettleQuaternion(q);
  return MakePose(
      Eigen::Quaterniond(settled[0], settled[1], settled[2], settled[3]).toRotationMatrix(), p);
}

Eigen::Vector4d QuaternionOf(const Pose& X) {
  const Eigen::Quaterniond q(X.linear());
  return {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace

Pose PoseFromNumbers(const double* numbers, const std::string& where) {
  const Eigen::Vector4d q(numbers[3], numbers[4], numbers[5], numbers[6]);
  const double length = q.norm();
  if (!(std::abs(length - 1.0) <= kQuaternionTolerance)) {
    throw Error(ErrorKind::kRange,
                fmt::format("{}: the quaternion has the length {:.6g}, expected 1 to within {}; "
                            "its order is w x y z",
                            where, length, kQuaternionTolerance));
  }
  return MakeSettledPose(q, {numbers[0], numbers[1], numbers[2]});
}

std::array<double, 7> NumbersFromPose(const Pose& X) {
  const Eigen::Vector4d q = SettleQuaternion(QuaternionOf(X));
  const Eigen::Vector3d p = X.translation();
  return {p.x(), p.y(), p.z(), q[0], q[1], q[2], q[3]};
}

Pose SettlePose(const Pose& X) { return MakeSettledPose(QuaternionOf(X), X.translation()); }

}  // namespace graspbench
