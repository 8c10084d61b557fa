#include "core/physics/implicit_world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/physics/known_answers/small_scenes.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

// What ImplicitWorld does to bodies and hands is on the sheet of known answers; here is what is
// left.

// A load of known size moves a free body as Newton says, and its work is accounted for.
TEST(ImplicitWorld, AnExternalLoadDoesItsWork) {
  SmallWorld body(MakeBlock(0.5), SimConfig());
  body.start().gravity_W.setZero();
  body.start().p_WOcm = Vector3d(0.0, 0.0, 1.0);
  body.Reset();
  const double I_xx = MakeBlock(0.5).mass_properties.I_OOcm(0, 0), t = 0.5;
  body.world().SetExternalLoad(Vector3d(0.0, 2.0, 0.0), Vector3d(1e-4, 0.0, 0.0));
  body.Run(t);
  EXPECT_NEAR(body.state().p_WOcm.y(), 0.5 * (2.0 / 0.5) * t * t, 1e-9);
  EXPECT_NEAR(body.state().w_WO.x(), 1e-4 / I_xx * t, 1e-6);
  const double work = 2.0 * 0.5 + 0.5 * 1e-4 * 1e-4 / I_xx * t * t;
  EXPECT_NEAR(body.world().energy().external, work, 1e-6);
  EXPECT_LT(std::abs(body.world().CalcEnergyResidual()), 1e-9);
  body.Reset();
  body.Step();
  EXPECT_EQ(body.state().v_WOcm.norm(), 0.0);
}

/** A rod of 50 mm on a spring of 2 N m/rad, drawn aside by 0.2 rad. */
class SwingingRod : public SmallWorld {
 public:
  static constexpr double kStiffness = 2.0;
  explicit SwingingRod(double armature)
      : SmallWorld(MakeRod(armature), MakeBlock(1e-9), MakeStepConfig(1e-4)) {
    start().gravity_W.setZero();
    start().p_WOcm = Vector3d(5.0, 0.0, 0.01);
    start().X_WH = MakePose(Vector3d(0.0, 0.0, 1.0));
    start().q[0] = 0.2;
    Reset(Eigen::VectorXd::Zero(1));
  }

 private:
  static Hand MakeRod(double armature) {
    Hand hand = MakeBareHand();
    AddRodLink(hand, 0, Pose::Identity(), Vector3d::UnitX(), 0.05, 0.05);
    hand.joints[0].drive = {kStiffness, 0.0, 10.0};
    hand.joints[0].drive.armature = armature;
    return hand;
  }
};

// The rotor swings along: the period is that of both inertias, and the energy stays.
TEST(ImplicitWorld, AnArmatureSwingsWithItsJoint) {
  SwingingRod bare(0.0);
  bare.start().u[0] = 1.0;
  bare.Reset();
  const double of_rod = 2.0 * bare.world().CalcKineticEnergy();
  EXPECT_NEAR(of_rod, 0.05 * 0.05 * 0.05 / 3.0, 0.01 * of_rod);  // of 50 g about its end
  for (const double armature : {0.0, 2e-4}) {
    SwingingRod rod(armature);
    const double quarter = 0.5 * M_PI * std::sqrt((of_rod + armature) / rod.kStiffness);
    rod.Run(quarter);
    const double speed = 0.2 * std::sqrt(rod.kStiffness / (of_rod + armature));
    EXPECT_NEAR(rod.state().q[0], 0.0, 1e-4 * speed) << armature;
    EXPECT_NEAR(rod.state().u[0], -speed, 1e-3 * speed) << armature;
    EXPECT_NEAR(rod.world().CalcKineticEnergy(), 0.5 * rod.kStiffness * 0.04, 1e-5) << armature;
    EXPECT_LT(std::abs(rod.world().CalcEnergyResidual()), 1e-6) << armature;
  }
}

// It turns with the joint alone.
TEST(ImplicitWorld, AnArmatureDoesNotTurnWithTheHand) {
  double energy[2];
  for (const int has_armature : {0, 1}) {
    SwingingRod rod(2e-4 * has_armature);
    rod.start().w_WH = Vector3d(3.0, 2.0, 1.0);
    rod.start().u.setZero();
    rod.Reset();
    energy[has_armature] = rod.world().CalcKineticEnergy();
  }
  EXPECT_GT(energy[0], 0.0);
  EXPECT_EQ(energy[0], energy[1]);
}

/** A squeezed prism that turns and slips between two fingers, on its way down. */
class SlippingScene : public SmallWorld {
 public:
  SlippingScene()
      : SmallWorld(MakeSqueezeHand(2, 0.02, 1.0, 0.003),
                   MakeSolid(MakePrism(4, 0.02, 0.06), 0.3, 0.4, 0.3), SimConfig()) {
    start().X_WH = MakePose(Vector3d(0.0, 0.0, 1.0 + kSqueezeLever));
    start().p_WOcm = Vector3d(0.0, 0.0, 1.0);
    start().w_WO = Vector3d(0.3, 0.1, 0.2);
    Reset();
  }
  void Reset() { SmallWorld::Reset(Eigen::Vector2d::Ones()); }  // the fingers press
};

// A clone leaves nothing behind: it goes on to the same bits, whatever happens to the other.
TEST(ImplicitWorld, ACloneGoesOnToTheSameBits) {
  SlippingScene scene;
  for (int i = 0; i < 20; ++i) scene.Step();
  ASSERT_GT(scene.Step().grip_force, 0.0);
  scene.world().SetExternalLoad(Vector3d(0.1, 0.0, 0.0), Vector3d(0.0, 1e-4, 0.0));
  const std::unique_ptr<World> clone = scene.world().Clone();
  WorldCommand command;
  command.q = Eigen::Vector2d::Ones();
  command.X_WH = scene.state().X_WH;
  std::vector<WorldState> expected;
  for (int i = 0; i < 60; ++i) {
    scene.world().Step(command);
    expected.push_back(scene.state());
  }
  const double residual = scene.world().CalcEnergyResidual();
  scene.Reset();
  for (const WorldState& state : expected) {
    clone->Step(command);
    ASSERT_EQ(clone->state().q, state.q);
    ASSERT_EQ(clone->state().u, state.u);
    ASSERT_EQ(clone->state().R_WO, state.R_WO);
    ASSERT_EQ(clone->state().v_WOcm, state.v_WOcm);
    ASSERT_EQ(clone->state().w_WO, state.w_WO);
  }
  EXPECT_EQ(clone->CalcEnergyResidual(), residual);
}

// Turned scene, turned motion: the direction of gravity is the only one that counts in free fall.
TEST(ImplicitWorld, FreeFallTurnsWithGravity) {
  SmallWorld body(MakeBlock(0.5), SimConfig());
  body.start().p_WOcm = Vector3d(0.0, 0.0, 5.0);
  const double t = 0.3;
  for (const Vector3d& gravity_W : {Vector3d(0, 0, -9.0), Vector3d(3.0, -4.0, 2.0)}) {
    body.Reset();
    body.world().SetGravity(gravity_W);
    body.Run(t);
    EXPECT_LT((body.state().v_WOcm - t * gravity_W).norm(), 1e-12);
    EXPECT_LT((body.state().p_WOcm - Vector3d(0, 0, 5) - 0.5 * t * t * gravity_W).norm(), 1e-12);
  }
}

// Where there is neither a table nor gravity, things stay; with gravity alone they fall for ever.
TEST(ImplicitWorld, MayHaveNoTableAndNoGravity) {
  const Hand hand = MakeBareHand();
  const GraspObject block = MakeBlock(0.1);
  for (const double gravity : {0.0, 9.0}) {
    ImplicitWorld world(hand, block, SimConfig(), TablePresence::kNone);
    WorldState state;
    state.X_WH = MakePose(Vector3d(0.0, 0.0, 5.0));
    state.p_WOcm = Vector3d(0.0, 0.0, 0.03);
    state.gravity_W = Vector3d(0.0, 0.0, -gravity);
    world.Reset(state);
    WorldCommand command;
    command.X_WH = state.X_WH;
    for (int step = 0; step < 250; ++step) EXPECT_EQ(world.Step(command).table_force, 0.0);
    EXPECT_NEAR(world.state().p_WOcm.z(), 0.03 - 0.5 * gravity * 0.5 * 0.5, 1e-9);
  }
}

}  // namespace
}  // namespace graspbench
