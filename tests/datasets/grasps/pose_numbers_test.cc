#include "datasets/grasps/pose_numbers.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/datasets/grasps/grasp_cases.h"

namespace graspbench {

namespace {

Pose DrawPose(std::mt19937& random, bool is_float) {
  std::normal_distribution<double> normal;
  Eigen::Vector4d q(normal(random), normal(random), normal(random), normal(random));
  q.normalize();
  double numbers[7] = {normal(random), normal(random), normal(random), q[0], q[1], q[2], q[3]};
  for (double& number : numbers) {
    if (is_float) number = static_cast<float>(number);
  }
  return PoseFromNumbers(numbers, "pose");
}

TEST(PoseNumbers, ComeBackBitByBit) {
  std::mt19937 random(43);
  for (int i = 0; i < 200000; ++i) {
    const Pose X = DrawPose(random, i % 2 == 0);
    const Pose again = PoseFromNumbers(NumbersFromPose(X).data(), "again");
    ASSERT_EQ(X.matrix(), again.matrix()) << i;
    ASSERT_EQ(SettlePose(X).matrix(), X.matrix()) << i;
  }
}

TEST(PoseNumbers, SettlingMovesByRoundingOnly) {
  std::mt19937 random(44);
  for (int i = 0; i < 1000; ++i) {
    const Pose X = DrawPose(random, false) * DrawPose(random, false);
    EXPECT_LT((SettlePose(X).matrix() - X.matrix()).cwiseAbs().maxCoeff(), 5e-14);
  }
}

TEST(PoseNumbers, LengthOfTheQuaternion) {
  for (const double scale : {0.9991, 1.0009}) {
    const double numbers[7] = {0, 0, 0, scale, 0, 0, 0};
    EXPECT_EQ(PoseFromNumbers(numbers, "pose").linear(), Eigen::Matrix3d::Identity());
  }
  for (const double scale : {0.0, 0.9989, 1.0011, std::nan("")}) {
    const double numbers[7] = {0, 0, 0, scale, 0, 0, 0};
    EXPECT_THROW(PoseFromNumbers(numbers, "pose"), std::exception) << scale;
  }
}

}  // namespace

}  // namespace graspbench
