#include "datasets/mjcf/commanded_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "core/physics/implicit_world.h"
#include "core/trial/protocols/table_lift.h"
#include "tests/datasets/mjcf/best_grasp_setup.h"

namespace graspbench {
namespace {

TEST(CommandedMotion, IsThatOfTheTrial) {
  const TrialSetup setup = MakeBestGraspSetup("tum-evolved", "toy_cube");
  TableLift course(std::make_unique<ImplicitWorld>(*setup.hand, *setup.object, setup.sim), setup);
  const TrialResult result = course.Run();
  ASSERT_EQ(result.outcome, Outcome::kSuccess);
  const CommandedMotion motion = RecordMotion(setup);
  EXPECT_NEAR(setup.sim.step * static_cast<double>(motion.steps.size()), result.simulated_time,
              1e-9);
  EXPECT_EQ(motion.steps.back().command.q, course.last_command().q);
  EXPECT_EQ(motion.steps.back().phase, Phase::kHold);
}

TEST(CommandedMotion, GoesOnToTheEndOfTheHoldWhenTheObjectIsLost) {
  TrialSetup setup = MakeBestGraspSetup("tum-evolved", "toy_cube");
  setup.draw.offset_x = 0.3;  // out of reach
  TableLift course(std::make_unique<ImplicitWorld>(*setup.hand, *setup.object, setup.sim), setup);
  const TrialResult result = course.Run();
  ASSERT_EQ(result.outcome, Outcome::kNoContact);
  const CommandedMotion motion = RecordMotion(setup);
  const double rest =
      setup.sim.step * static_cast<double>(motion.steps.size()) - result.simulated_time;
  EXPECT_NEAR(rest, setup.strategy.lift_time + setup.strategy.hold_time, 2.1 * setup.sim.step);
  // From the first row to the last without a jump: no faster than the lift's course is.
  const double fastest = 1.875 * setup.grasp.approach_distance;  // minimum jerk, in one second
  for (size_t i = 1; i < motion.steps.size(); ++i) {
    const Eigen::Vector3d way =
        motion.steps[i].command.X_WH.translation() - motion.steps[i - 1].command.X_WH.translation();
    EXPECT_LE(way.norm(), 1.3 * fastest * setup.sim.step) << i;
  }
  EXPECT_NEAR(
      (motion.steps.back().command.X_WH.translation() - motion.start.X_WH.translation()).norm(),
      setup.grasp.approach_distance, 0.05);
  const std::string csv = FormatMotionCsv(*setup.hand, motion);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'),
            static_cast<std::ptrdiff_t>(motion.steps.size()) + 2);
}

}  // namespace
}  // namespace graspbench
