// The same bits whatever ran before, beside or in which order. A trajectory is hashed step by step
// over all positions and speeds.

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "core/base/hash.h"
#include "core/grasp/placement.h"
#include "core/physics/implicit_world.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

template <class Matrix>
void AddBytes(const Matrix& values, uint64_t& hash) {
  hash = CalcHash64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)},
                    hash);
}

/** A hand that closes on a cube on the table and shakes it about, without regard to phases: 1.2 s.
 */
uint64_t HashTrajectory(const TrialSetup& setup, World& world) {
  const Placement placement = CalcPlacement(*setup.hand, setup.grasp, setup.object->size,
                                            setup.object->mass_properties.p_OOcm);
  WorldState state;
  state.X_WH = placement.X_WH;
  state.q = setup.grasp.q_pre;
  state.u = Eigen::VectorXd::Zero(world.dynamics().num_dofs());
  state.p_WOcm = Eigen::Vector3d(0.001, 0.002, 0.5 * setup.object->size.z());
  world.Reset(state);
  WorldCommand command;
  command.X_WH = state.X_WH;
  command.q = setup.grasp.q_target;
  uint64_t hash = 0;
  for (int i = 0; i < 600; ++i) {
    if (i == 300) world.SetGravity(Eigen::Vector3d(4.0, -3.0, -6.0));
    world.Step(command);
    const WorldState& now = world.state();
    AddBytes(now.q, hash);
    AddBytes(now.u, hash);
    AddBytes(now.R_WO, hash);
    AddBytes(now.p_WOcm, hash);
    AddBytes(now.w_WO, hash);
    AddBytes(now.v_WOcm, hash);
  }
  return hash;
}

class DeterminismTest : public testing::TestWithParam<const char*> {
 protected:
  DeterminismTest()
      : setup_(MakeSetup(GetParam(), "g2", MakeCube(0.0122, 0.5))),
        other_(MakeSetup(setup_.hand, "g3", setup_.object)) {
    other_.draw.offset_x = 0.004;
    other_.draw.offset_yaw = 0.3;
  }
  ImplicitWorld MakeWorld() const {
    return ImplicitWorld(*setup_.hand, *setup_.object, setup_.sim);
  }

  TrialSetup setup_, other_;
};

TEST_P(DeterminismTest, ATrajectoryRepeatsInAFreshAndInAUsedWorld) {
  ImplicitWorld world = MakeWorld(), fresh = MakeWorld();
  const uint64_t first = HashTrajectory(setup_, world);
  EXPECT_NE(HashTrajectory(other_, world), first);
  EXPECT_EQ(HashTrajectory(setup_, world), first);
  EXPECT_EQ(HashTrajectory(setup_, fresh), first);
}

// The record holds the sums of all work, so that every step leaves its mark in it.
TEST_P(DeterminismTest, RecordsDoNotDependOnOrderThreadOrRunner) {
  const TrialSetup* setups[] = {&setup_, &other_};
  const auto run = [](TrialRunner& runner, const TrialSetup& setup) {
    return ToJson(runner.Run(setup)).dump();
  };
  TrialRunner runner(setup_.hand, setup_.object);
  std::string records[2];
  for (int i : {0, 1}) records[i] = run(runner, *setups[i]);
  EXPECT_NE(records[0], records[1]);
  for (int i : {1, 0, 0}) EXPECT_EQ(run(runner, *setups[i]), records[i]);
  std::string parallel[2];
  std::vector<std::thread> threads;
  for (int i : {1, 0}) {
    threads.emplace_back([&, i] {
      TrialRunner own(setup_.hand, setup_.object);
      parallel[i] = run(own, *setups[i]);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (int i : {0, 1}) EXPECT_EQ(parallel[i], records[i]);
}

INSTANTIATE_TEST_SUITE_P(Hands, DeterminismTest, testing::Values("tum", "shadow"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace graspbench
