#include "core/trial/protocols/protocol.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/error.h"
#include "core/physics/implicit_world.h"
#include "core/trial/trial_runner.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

TEST(Protocol, HasAnIdOfItsOwnThatFindsIt) {
  std::set<std::string> ids;
  for (const Protocol* protocol : ListProtocols()) {
    EXPECT_TRUE(ids.insert(protocol->id).second) << protocol->id;
    EXPECT_EQ(&FindProtocol(protocol->id), protocol);
  }
}

TEST(Protocol, AnUnknownOneIsRefusedWithTheNearest) {
  try {
    FindProtocol("table_lyft");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_NE(std::string(error.what()).find("\"table_lyft\""), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("table_lift"), std::string::npos) << error.what();
  }
}

TEST(Protocol, AnUnknownOneInASetupIsAResultWithItsReason) {
  TrialSetup setup = MakeSetup("tum", "g2", MakeCube(0.0122, 0.5));
  setup.protocol = "juggling";
  const TrialResult result = TrialRunner(setup.hand, setup.object).Run(setup);
  EXPECT_EQ(result.outcome, Outcome::kNumericalFailure);
  EXPECT_NE(result.reason.find("juggling"), std::string::npos) << result.reason;
}

/** Where there is neither a table nor gravity, things stay; with gravity alone they fall for ever.
*/
TEST(Protocol, AWorldMayHaveNoTableAndNoGravity) {
  for (const double gravity : {0.0, 9.0}) {
    TrialSetup setup = MakeSetup("tum", "g2", MakeCube(0.0122, 0.5));
    setup.sim.gravity = gravity;
    ImplicitWorld world(*setup.hand, *setup.object, setup.sim, TablePresence::kNone);
    WorldState state;
    state.q = setup.grasp.q_pre;
    state.u = Eigen::VectorXd::Zero(world.dynamics().num_dofs());
    state.X_WH.translation() = Eigen::Vector3d(0.0, 0.0, 5.0);  // far from the object
    state.p_WOcm = Eigen::Vector3d(0.0, 0.0, 0.03);
    state.gravity_W = MakeGravity(setup.sim);
    world.Reset(state);
    WorldCommand command;
    command.q = setup.grasp.q_pre;
    command.X_WH = state.X_WH;
    constexpr int kNumSteps = 250;
    double table_force = 0.0;
    for (int step = 0; step < kNumSteps; ++step) table_force += world.Step(command).table_force;
    const double t = kNumSteps * setup.sim.step;
    EXPECT_EQ(table_force, 0.0);
    EXPECT_NEAR(world.state().p_WOcm.z(), 0.03 - 0.5 * gravity * t * t, 1e-9);
  }
}

}  // namespace
}  // namespace graspbench
