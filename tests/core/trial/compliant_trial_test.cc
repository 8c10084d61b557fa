#include "core/trial/compliant_trial.h"

#include <gtest/gtest.h>

#include "core/hand/load_hand.h"
#include "core/physics/simbody/compliant_world.h"
#include "core/trial/trial_runner.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

TEST(CompliantTrial, TakesBalls) {
  EXPECT_TRUE(CanMoveCompliantly(*LoadObject("golf_ball")));
  EXPECT_TRUE(CanMoveCompliantly(*LoadObject("tennis_ball")));
  EXPECT_FALSE(CanMoveCompliantly(*LoadObject("toy_cube")));
  EXPECT_FALSE(CanMoveCompliantly(*LoadObject("can")));
}

TEST(CompliantTrial, TouchesAndGripsAsOurOwnWorldDoes) {
  TrialSetup setup;
  setup.hand = std::make_shared<const Hand>(LoadHand("tum-evolved"));
  setup.object = LoadObject("golf_ball");
  setup.grasp = LoadStandardGrasps(*setup.hand).front();
  setup.draw.joint_error = Eigen::VectorXd::Zero(setup.hand->num_joints());
  const TrialResult ours = TrialRunner(setup.hand, setup.object).Run(setup);
  const TrialResult theirs = RunCompliantTrial(setup);
  EXPECT_EQ(theirs.outcome, ours.outcome) << theirs.reason;
  EXPECT_NEAR(theirs.timing.gct, ours.timing.gct, 0.01);
  EXPECT_NEAR(theirs.timing.gft, ours.timing.gft, 0.01);
  EXPECT_NEAR(theirs.grip_force, ours.grip_force, 0.05 * ours.grip_force);
}

}  // namespace
}  // namespace graspbench
