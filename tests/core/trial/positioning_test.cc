#include "core/trial/positioning.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "core/physics/implicit_world.h"
#include "core/trial/protocols/table_lift.h"
#include "core/trial/trial_runner.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

class PositioningTest : public testing::Test {
 protected:
  static TrialSetup MakeTrial(const char* object, const char* grasp_id) {
    TrialSetup setup;
    setup.hand = std::make_shared<const Hand>(LoadHand("tum-evolved"));
    setup.object = LoadObject(object);
    for (const Grasp& grasp : LoadStandardGrasps(*setup.hand)) {
      if (grasp.id == grasp_id) setup.grasp = grasp;
    }
    setup.draw.joint_error = Eigen::VectorXd::Zero(setup.hand->num_joints());
    return setup;
  }
  static TrialResult Run(const TrialSetup& setup) {
    return TrialRunner(setup.hand, setup.object).Run(setup);
  }
  static Pose FindRelativePose(const SceneSnapshot& snapshot) {
    return snapshot.X_WH.inverse() * snapshot.X_WO;
  }
};

// Who knows the object's place exactly meets it as if it lay where it should: the whole trial is
// moved over the table.
TEST_F(PositioningTest, TrueMeetsTheObjectAsWithoutOffset) {
  TrialSetup setup = MakeTrial("remote_control", "g1");
  const TrialResult centred = Run(setup);
  ASSERT_EQ(centred.outcome, Outcome::kSuccess) << centred.reason;
  EXPECT_TRUE(std::isnan(centred.believed_x));
  EXPECT_FALSE(ToJson(centred).contains("believed_x_m"));

  setup.draw.offset_x = 0.03;
  setup.draw.offset_y = -0.02;
  setup.draw.offset_yaw = 0.6;
  setup.positioning = Positioning::kTrue;
  const TrialResult moved = Run(setup);
  EXPECT_EQ(moved.outcome, Outcome::kSuccess) << moved.reason;
  EXPECT_EQ(moved.believed_x, 0.03);
  EXPECT_EQ(moved.believed_yaw, 0.6);
  ASSERT_EQ(moved.snapshots.size(), centred.snapshots.size());
  const Pose difference =
      FindRelativePose(centred.snapshots[0]).inverse() * FindRelativePose(moved.snapshots[0]);
  EXPECT_LT(difference.translation().norm(), 1e-4);
  EXPECT_LT(Eigen::AngleAxisd(difference.linear()).angle(), 1e-3);
  EXPECT_NEAR(moved.timing.gct, centred.timing.gct, 0.01);

  setup.positioning = Positioning::kNominal;
  EXPECT_NE(Run(setup).outcome, Outcome::kSuccess);
}

TEST_F(PositioningTest, TheCameraFindsTheObject) {
  TrialSetup setup = MakeTrial("remote_control", "g1");
  setup.draw.offset_x = 0.03;
  setup.draw.offset_y = -0.02;
  setup.draw.offset_yaw = 0.6;
  setup.positioning = Positioning::kCamera;
  const TrialResult result = Run(setup);
  EXPECT_EQ(result.outcome, Outcome::kSuccess) << result.reason;
  EXPECT_NEAR(result.believed_x, 0.03, 0.001);
  EXPECT_NEAR(result.believed_y, -0.02, 0.001);
  EXPECT_NEAR(result.believed_yaw, 0.6, RadFromDeg(1.0));
  EXPECT_EQ(ToJson(TrialResultFromJson(ToJson(result))), ToJson(result));
  // The same again, by a course that makes its own camera.
  EXPECT_EQ(ToJson(TableLift(std::make_unique<ImplicitWorld>(*setup.hand, *setup.object, setup.sim),
                             setup)
                       .Run()),
            ToJson(result));
}

TEST_F(PositioningTest, WhatIsNotSeenIsAResultWithItsReason) {
  TrialSetup setup = MakeTrial("remote_control", "g1");
  setup.draw.offset_x = 0.2;
  setup.positioning = Positioning::kCamera;
  const TrialResult result = Run(setup);
  EXPECT_EQ(result.outcome, Outcome::kNotSeen);
  EXPECT_EQ(result.reason, "what is seen reaches over the picture's edge");
  EXPECT_EQ(result.num_steps, 0);
  EXPECT_TRUE(std::isnan(result.believed_x));
  EXPECT_EQ(ToJson(TrialResultFromJson(ToJson(result))), ToJson(result));
}

}  // namespace
}  // namespace graspbench
