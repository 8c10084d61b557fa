#include "datasets/grasps/pose_numbers.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/error.h"

namespace graspbench {
namespace {

Pose FromUnit(const double* numbers) {
  const Eigen::Quaterniond q(numbers[3], numbers[4], numbers[5], numbers[6]);
  return MakePose(q.normalized().toRotationMatrix(), {numbers[0], numbers[1], numbers[2]});
}

bool AreSame(const Pose& a, const Pose& b) { return a.matrix() == b.matrix(); }

bool IsBefore(const Pose& a, const Pose& b) {
  const Eigen::Matrix4d m = a.matrix(), n = b.matrix();
  return std::lexicographical_compare(m.data(), m.data() + 16, n.data(), n.data() + 16);
}

}  // namespace

Pose PoseFromNumbers(const double* numbers, const std::string& where) {
  const double length = Eigen::Quaterniond(numbers[3], numbers[4], numbers[5], numbers[6]).norm();
  if (!(std::abs(length - 1.0) <= kQuaternionTolerance)) {
    throw Error(ErrorKind::kRange,
                fmt::format("{}: the quaternion has the length {:.6g}, expected 1 to within {}; "
                            "its order is w x y z",
                            where, length, kQuaternionTolerance));
  }
  return SettlePose(FromUnit(numbers));
}

std::array<double, 7> NumbersFromPose(const Pose& X) {
  Eigen::Quaterniond q(X.linear());
  q.normalize();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const Eigen::Vector3d p = X.translation();
  return {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

Pose SettlePose(const Pose& X) {
  constexpr int kMaxRounds = 64;  // a few are usual
  std::vector<Pose> seen = {X};
  for (int round = 0; round < kMaxRounds; ++round) {
    const Pose next = FromUnit(NumbersFromPose(seen.back()).data());
    for (size_t i = 0; i < seen.size(); ++i) {
      if (!AreSame(seen[i], next)) continue;
      return *std::min_element(seen.begin() + static_cast<std::ptrdiff_t>(i), seen.end(), IsBefore);
    }
    seen.push_back(next);
  }
  return seen.back();
}

}  // namespace graspbench
