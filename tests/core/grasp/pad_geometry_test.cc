#include "core/grasp/pad_geometry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/pose.h"
#include "core/base/random.h"

namespace graspbench {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

Matrix3Xd DrawColumns(int count, RandomStream& random) {
  Matrix3Xd drawn(3, count);
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) drawn(k, i) = random.NextNormal();
  }
  return drawn;
}

TEST(PadGeometry, CornersOfASquareAboveAndBelowItsPlaneAreOffByTheirHeight) {
  Matrix3Xd pads(3, 4);
  pads << 0.03, -0.03, -0.03, 0.03, 0.03, 0.03, -0.03, -0.03, 0.004, -0.004, 0.004, -0.004;
  EXPECT_NEAR(CalcPlaneResidual(pads), 0.004, 1e-12);
  pads.row(2).setConstant(0.2);
  EXPECT_NEAR(CalcPlaneResidual(pads), 0.0, 1e-9);
  EXPECT_TRUE(std::isnan(CalcPlaneResidual(pads.leftCols(3))));
}

TEST(PadGeometry, NoOtherPlaneIsNearer) {
  RandomStream random("plane", "test");
  for (int round = 0; round < 50; ++round) {
    const Matrix3Xd pads = DrawColumns(5, random);
    const double residual = CalcPlaneResidual(pads);
    const Vector3d mean = pads.rowwise().mean();
    for (int other = 0; other < 50; ++other) {
      const Vector3d normal = DrawColumns(1, random).col(0).normalized();
      const double away =
          std::sqrt((normal.transpose() * (pads.colwise() - mean)).squaredNorm() / 5.0);
      EXPECT_GE(away, residual - 1e-12);
    }
  }
}

TEST(PadGeometry, LinesThroughOnePointMeetAndParallelOnesKeepTheirSpacing) {
  RandomStream random("meeting", "test");
  const Matrix3Xd pads = DrawColumns(5, random);
  const Vector3d point(0.3, -0.2, 0.1);
  EXPECT_NEAR(CalcMeetingResidual(pads, (-pads).colwise() + point), 0.0, 1e-12);
  Matrix3Xd row = Matrix3Xd::Zero(3, 5);
  row.row(0) << -0.04, -0.02, 0.0, 0.02, 0.04;
  const Matrix3Xd up = Vector3d::UnitZ().replicate(1, 5);
  EXPECT_NEAR(CalcMeetingResidual(row, up), std::sqrt(8.0e-4), 1e-12);
}

TEST(PadGeometry, SkewLinesMeetHalfwayAndTheLengthOfADirectionDoesNotMatter) {
  Matrix3Xd pads(3, 2), directions(3, 2);
  pads << 0.5, 0.0, 0.0, -0.7, 0.0, 0.06;
  directions << 1.0, 0.0, 0.0, -3.0, 0.0, 0.0;
  EXPECT_NEAR(CalcMeetingResidual(pads, directions), 0.03, 1e-12);
  directions.col(0) *= 1e-4;
  EXPECT_NEAR(CalcMeetingResidual(pads, directions), 0.03, 1e-12);
}

TEST(PadGeometry, NoOtherPointIsNearerToTheLinesAndAMotionOfTheHandChangesNothing) {
  RandomStream random("nearest", "test");
  const Pose X = MakePose(MakeRotationRpy(0.3, 1.1, -2.0), Vector3d(1, 2, 3));
  for (int round = 0; round < 50; ++round) {
    const Matrix3Xd pads = DrawColumns(4, random), directions = DrawColumns(4, random);
    const double residual = CalcMeetingResidual(pads, directions);
    for (int other = 0; other < 50; ++other) {
      const Vector3d point = DrawColumns(1, random).col(0);
      double sum = 0.0;
      for (int i = 0; i < 4; ++i) {
        sum += (point - pads.col(i)).cross(directions.col(i).normalized()).squaredNorm();
      }
      EXPECT_GE(std::sqrt(sum / 4.0), residual - 1e-12);
    }
    const Matrix3Xd moved = (X.linear() * pads).colwise() + X.translation();
    EXPECT_NEAR(CalcMeetingResidual(moved, X.linear() * directions), residual, 1e-12);
    EXPECT_NEAR(CalcPlaneResidual(moved), CalcPlaneResidual(pads), 1e-12);
  }
}

TEST(PadGeometry, AResidualOfNothingIsMissing) {
  RandomStream random("missing", "test");
  Matrix3Xd pads = DrawColumns(4, random), directions = DrawColumns(4, random);
  EXPECT_TRUE(std::isnan(CalcMeetingResidual(pads.leftCols(1), directions.leftCols(1))));
  directions.col(2).setZero();
  EXPECT_TRUE(std::isnan(CalcMeetingResidual(pads, directions)));
  pads(1, 1) = std::nan("");
  EXPECT_TRUE(std::isnan(CalcMeetingResidual(pads, DrawColumns(4, random))));
  EXPECT_TRUE(std::isnan(CalcPlaneResidual(pads)));
}

}  // namespace
}  // namespace graspbench
