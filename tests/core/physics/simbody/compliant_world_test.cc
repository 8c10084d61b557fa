#include "core/physics/simbody/compliant_world.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/physics/known_answers/small_scenes.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** A ball of 20 mm radius in the air; nothing else is near. */
class CompliantWorldTest : public testing::Test {
 protected:
  CompliantWorldTest()
      : ball_(MakeSolid(MakeSphere(0.02), 0.1, 0.5, 0.5)),
        world_(MakeCompliantWorld(hand_, ball_, SimConfig())) {
    state_.X_WH = command_.X_WH = MakePose(Vector3d(0.0, 0.0, 10.0));
    state_.q = state_.u = command_.q = Eigen::VectorXd::Zero(0);
    state_.p_WOcm = Vector3d(0.0, 0.0, 1.0);
    world_->Reset(state_);
  }
  static void Run(World& world, const WorldCommand& command, int num_steps) {
    for (int i = 0; i < num_steps; ++i) world.Step(command);
  }

  Hand hand_ = MakeBareHand();
  GraspObject ball_;
  std::unique_ptr<World> world_;
  WorldState state_;
  WorldCommand command_;
};

TEST_F(CompliantWorldTest, ABallFallsAsGalileoSays) {
  Run(*world_, command_, 100);
  const double t = 100 * SimConfig().step;
  EXPECT_NEAR(world_->state().p_WOcm.z(), 1.0 - 0.5 * kStandardGravity * t * t, 1e-4);
  EXPECT_NEAR(world_->state().v_WOcm.z(), -kStandardGravity * t, 1e-3);
}

TEST_F(CompliantWorldTest, ACloneGoesOnFromTheSameInstantOnItsOwn) {
  Run(*world_, command_, 50);
  const std::unique_ptr<World> clone = world_->Clone();
  EXPECT_EQ(clone->state().p_WOcm, world_->state().p_WOcm);
  EXPECT_EQ(clone->state().v_WOcm, world_->state().v_WOcm);
  Run(*clone, command_, 50);
  const double t = 50 * SimConfig().step;
  EXPECT_NEAR(world_->state().v_WOcm.z(), -kStandardGravity * t, 1e-3) << "the first one waits";
  EXPECT_NEAR(clone->state().v_WOcm.z(), -2.0 * kStandardGravity * t, 1e-3);
  Run(*world_, command_, 50);
  // Each keeps its local error below 1e-4; what they differ by is a few of those.
  EXPECT_LT((clone->state().p_WOcm - world_->state().p_WOcm).norm(), 5e-4);
}

TEST_F(CompliantWorldTest, RefusesWhatItCannotDo) {
  EXPECT_FALSE(CanMoveCompliantly(MakeBlock(0.1)));
  EXPECT_THROW(world_->SetGravity(Vector3d::Zero()), Error);
  EXPECT_THROW(world_->SetExternalLoad(Vector3d::UnitX(), Vector3d::Zero()), Error);
}

}  // namespace
}  // namespace graspbench
