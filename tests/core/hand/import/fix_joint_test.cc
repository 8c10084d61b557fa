#include "core/hand/import/fix_joint.h"

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace graspbench {
namespace {

// A turn of 90 deg about z, and a slide along x that follows it: 0.01 m + 0.02 m/rad.
TEST(FixJointTest, HoldsTheJointAndThoseThatFollow) {
  ForeignHand hand;
  hand.joints.resize(2);
  hand.joints[0].kind = ForeignJoint::Kind::kRevolute;
  hand.joints[0].axis = Eigen::Vector3d::UnitZ();
  hand.joints[0].X_PJ = MakePose({1.0, 0.0, 0.0});
  hand.joints[1].kind = ForeignJoint::Kind::kPrismatic;
  hand.joints[1].mimic.emplace();
  hand.joints[1].mimic->joint = 0;
  hand.joints[1].mimic->ratio = 0.02;
  hand.joints[1].mimic->offset = 0.01;
  FixJoint(hand, 0, 0.5 * kPi);
  const Eigen::Vector3d x = hand.joints[0].X_PJ * Eigen::Vector3d::UnitX();
  EXPECT_LT((x - Eigen::Vector3d(1.0, 1.0, 0.0)).norm(), 1e-15);
  EXPECT_NEAR(hand.joints[1].X_PJ.translation().x(), 0.01 + 0.01 * kPi, 1e-15);
  for (const ForeignJoint& joint : hand.joints) {
    EXPECT_EQ(joint.kind, ForeignJoint::Kind::kFixed);
    EXPECT_FALSE(joint.mimic);
  }
}

}  // namespace
}  // namespace graspbench
