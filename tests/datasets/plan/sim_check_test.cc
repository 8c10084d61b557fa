#include "datasets/plan/sim_check.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TEST(SimCheck, ContradictionsAreNamedByTheirKey) {
  EXPECT_TRUE(FindSimProblems(SimConfig()).empty());
  SimConfig sim;
  sim.hand_friction_dynamic = sim.hand_friction_static + 0.1;
  sim.table_friction_dynamic = sim.table_friction_static + 0.1;
  sim.multibody = "mujoco";
  const auto problems = FindSimProblems(sim);
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_EQ(problems[0].first, "sim.table_friction_dynamic");
  EXPECT_EQ(problems[1].first, "sim.hand_friction_dynamic");
  EXPECT_EQ(problems[2].first, "sim.multibody");
}

}  // namespace
}  // namespace graspbench
