#include "core/base/pose.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d MakeRotation(const Vector3d& rpy) {
  return (AngleAxisd(rpy.z(), Vector3d::UnitZ()) * AngleAxisd(rpy.y(), Vector3d::UnitY()) *
          AngleAxisd(rpy.x(), Vector3d::UnitX()))
      .toRotationMatrix();
}

TEST(RollPitchYaw, GivesTheAnglesBack) {
  for (const Vector3d& rpy :
       {Vector3d(0.3, -0.7, 2.9), Vector3d(-3.0, 1.5, -1.0), Vector3d(0, 0, 0)}) {
    EXPECT_LT((CalcRollPitchYaw(MakeRotation(rpy)) - rpy).norm(), 1e-12);
  }
}

// There roll and yaw are one angle; what is given turns the same way.
TEST(RollPitchYaw, GivesTheRotationBackAtAPitchOfNinetyDegrees) {
  for (const double pitch : {std::asin(1.0), -std::asin(1.0)}) {
    const Matrix3d R = MakeRotation(Vector3d(0.4, pitch, 1.1));
    EXPECT_LT((MakeRotation(CalcRollPitchYaw(R)) - R).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace graspbench
