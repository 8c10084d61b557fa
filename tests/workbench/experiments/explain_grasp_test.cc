#include "workbench/experiments/explain_grasp.h"

#include <gtest/gtest.h>

#include "tests/workbench/experiments/pinch_inputs.h"

namespace graspbench {
namespace {

TEST(ExplainGrasp, NamesTheValueThatTurnsTheVerdict) {
  const GraspInputs inputs = MakePinchInputs();
  const FreeSpaceProfile from = MakePinchProfile();
  FreeSpaceProfile to = from;
  to.drives.damping = 0.04;     // of given drives: nothing changes
  to.surfaces.friction = 0.05;  // 0.5 N at most, and the push is 1 N
  to.test_time = 0.2;
  const std::vector<ExplainStep> steps = ExplainGrasp(inputs, inputs.grasps.front(), from, to);
  ASSERT_EQ(steps.size(), 4u);
  EXPECT_TRUE(steps[0].result.passed) << steps[0].result.reason;
  EXPECT_EQ(steps[1].key, "drives.damping_nms_per_rad");
  EXPECT_FALSE(steps[1].turns);
  EXPECT_EQ(steps[2].key, "surfaces.friction");
  EXPECT_TRUE(steps[2].turns);
  EXPECT_EQ(steps[2].from, "0.5");
  EXPECT_FALSE(steps[2].result.passed);
  EXPECT_EQ(steps[3].key, "test_time_s");
}

}  // namespace
}  // namespace graspbench
