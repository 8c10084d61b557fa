#include "core/sim/world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "tests/core/sim/sim_fixtures.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

SimConfig MakeConfig(double step) {
  SimConfig config;
  config.step = step;
  return config;
}

/** A body alone in the world; the hand's root hangs 10 m above. */
class BodyWorld {
 public:
  BodyWorld(GraspObject object, const SimConfig& config)
      : hand_(MakeBareHand()), object_(std::move(object)), world_(hand_, object_, config) {
    state_.X_WH = MakePose(Vector3d(0.0, 0.0, 10.0));
    state_.q = VectorXd();
    state_.u = VectorXd();
  }
  WorldState& state() { return state_; }
  void Start() { world_.Reset(state_); }
  StepReport Step() {
    WorldCommand command;
    command.q = VectorXd();
    command.X_WH = state_.X_WH;
    return world_.Step(command);
  }
  void Run(int steps) {
    for (int i = 0; i < steps; ++i) ASSERT_TRUE(Step().converged);
  }
  World& world() { return world_; }

 private:
  Hand hand_;
  GraspObject object_;
  World world_;
  WorldState state_;
};

GraspObject MakeBlock(double mass) {
  return MakeTestObject(MakeRoundedBox(Vector3d(0.06, 0.04, 0.02), 0.0), mass, 0.5, 0.5);
}

// z = z0 + v0 t - g t^2 / 2 holds exactly for the midpoint rule.
TEST(World, FreeFallIsAParabola) {
  BodyWorld body(MakeBlock(0.5), MakeConfig(0.002));
  body.state().p_WOcm = Vector3d(0.0, 0.0, 2.0);
  body.state().v_WOcm = Vector3d(0.3, 0.0, 1.0);
  body.Start();
  body.Run(250);
  const double t = 0.5;
  EXPECT_NEAR(body.world().state().p_WOcm.x(), 0.3 * t, 1e-9);
  EXPECT_NEAR(body.world().state().p_WOcm.z(), 2.0 + t - 0.5 * kStandardGravity * t * t, 1e-7);
}

// Without torque the angular momentum in W and the kinetic energy stay; the motion about the middle
// axis is unstable (Dzhanibekov), so it visits all orientations.
TEST(World, TorqueFreeSpinKeepsMomentumAndEnergy) {
  BodyWorld body(MakeBlock(0.5), MakeConfig(0.001));
  body.state().gravity_W.setZero();
  body.state().p_WOcm = Vector3d(0.0, 0.0, 1.0);
  body.state().w_WO = Vector3d(0.01, 10.0, 0.02);
  body.Start();
  const Eigen::Matrix3d I = MakeBlock(0.5).mass_properties.I_OOcm;
  const auto momentum = [&] {
    const WorldState& s = body.world().state();
    return Vector3d(s.R_WO * I * s.R_WO.transpose() * s.w_WO);
  };
  const Vector3d L0 = momentum();
  const double E0 = body.world().CalcKineticEnergy();
  double smallest = 1.0;
  for (int i = 0; i < 5000; ++i) {
    body.Step();
    smallest = std::min(smallest, body.world().state().R_WO(1, 1));
  }
  EXPECT_LT(smallest, -0.9) << "the middle axis should have flipped";
  EXPECT_LT((momentum() - L0).norm() / L0.norm(), 1e-3);
  EXPECT_NEAR(body.world().CalcKineticEnergy() / E0, 1.0, 1e-3);
}

// Four corners carry the block: depth = m g / (4 k).
TEST(World, StaticDepthIsWeightOverStiffness) {
  SimConfig config = MakeConfig(0.002);
  config.contact_stiffness = 2e4;
  BodyWorld body(MakeBlock(0.5), config);
  body.state().p_WOcm = Vector3d(0.0, 0.0, 0.01);
  body.Start();
  body.Run(500);
  EXPECT_NEAR(0.01 - body.world().state().p_WOcm.z(), 0.5 * kStandardGravity / (4.0 * 2e4), 1e-9);
  EXPECT_LT(body.world().state().v_WOcm.norm(), 1e-9);
}

struct Incline {
  double mu, step;
};
class InclineTest : public testing::TestWithParam<Incline> {
 protected:
  /** Slides down the slope after `time` on a table tilted so that tan(angle) = ratio * mu. */
  WorldState Run(double ratio, double time) {
    SimConfig config = MakeConfig(GetParam().step);
    config.table_friction_static = config.table_friction_dynamic = GetParam().mu;
    config.tangential_stiffness = kStiffness;
    BodyWorld body(MakeBlock(0.5), config);
    angle_ = std::atan(ratio * GetParam().mu);
    body.state().p_WOcm = Vector3d(0.0, 0.0, 0.01);
    body.Start();
    // The table tilts slowly and then stays.
    const int num_tilting = static_cast<int>(std::lround(0.4 / GetParam().step));
    for (int i = 1; i <= num_tilting; ++i) {
      const double angle = angle_ * i / num_tilting;
      body.world().SetGravity(kStandardGravity * Vector3d(std::sin(angle), 0.0, -std::cos(angle)));
      EXPECT_TRUE(body.Step().converged);
    }
    body.Run(static_cast<int>(std::lround(time / GetParam().step)));
    return body.world().state();
  }
  static constexpr double kStiffness = 4e4;
  double angle_ = 0.0;
};

TEST_P(InclineTest, SticksBelowTheFrictionAngle) {
  const WorldState early = Run(0.99, 0.2), late = Run(0.99, 0.5);
  EXPECT_LT(late.v_WOcm.norm(), 1e-8);  // the solver's tolerance, 1e-9 N s, over 0.5 kg
  EXPECT_LT((late.p_WOcm - early.p_WOcm).norm(), 1e-9);
  // The bristles carry the load, elastically: m g sin(angle) / (4 kt), and the block leans a
  // little.
  const double stretch = 0.5 * kStandardGravity * std::sin(angle_) / (4.0 * kStiffness);
  EXPECT_GT(late.p_WOcm.x(), stretch);
  EXPECT_LT(late.p_WOcm.x(), 2.0 * stretch);
}

TEST_P(InclineTest, SlidesAboveItWithTheRightAcceleration) {
  for (double ratio : {1.01, 1.10}) {
    const double early = Run(ratio, 0.3).v_WOcm.x(), late = Run(ratio, 0.5).v_WOcm.x();
    const double expected =
        kStandardGravity * (std::sin(angle_) - GetParam().mu * std::cos(angle_));
    EXPECT_NEAR((late - early) / 0.2, expected, 2e-3 * expected) << "ratio " << ratio;
  }
}

INSTANTIATE_TEST_SUITE_P(Friction, InclineTest,
                         testing::Values(Incline{0.3, 0.0005}, Incline{0.3, 0.002},
                                         Incline{0.5, 0.001}, Incline{0.5, 0.004},
                                         Incline{1.1, 0.002}));

TEST(World, ABouncingBallNeverRisesAgain) {
  SimConfig config = MakeConfig(0.002);
  config.contact_dissipation = 0.0;
  BodyWorld body(MakeTestObject(MakeSphere(0.02), 0.05, 0.5, 0.5), config);
  body.state().p_WOcm = Vector3d(0.0, 0.0, 0.1);
  body.Start();
  double highest_after_bounce = 0.0;
  bool has_bounced = false;
  for (int i = 0; i < 1000; ++i) {
    const StepReport report = body.Step();
    has_bounced = has_bounced || report.table_force > 0.0;
    if (has_bounced) {
      highest_after_bounce = std::max(highest_after_bounce, body.world().state().p_WOcm.z());
    }
  }
  EXPECT_TRUE(has_bounced);
  EXPECT_LT(highest_after_bounce, 0.1);
}

/** Three links swinging in a plane and out of it, without drives. */
Hand MakePendulum() {
  Hand hand = MakeBareHand();
  AddTestLink(hand, 0, Pose::Identity(), Vector3d::UnitX(), 0.05, 0.05);
  AddTestLink(hand, 1, MakePose(Vector3d(0, 0, 0.05)), Vector3d::UnitX(), 0.03, 0.03);
  AddTestLink(hand, 2, MakePose(Vector3d(0, 0, 0.03)), Vector3d::UnitY(), 0.02, 0.02);
  return hand;
}

double CalcPotentialEnergy(const Hand& hand, World& world) {
  double energy = 0.0;
  world.dynamics().UpdatePositions(world.state().X_WH, world.state().q);
  for (size_t i = 1; i < hand.links.size(); ++i) {
    const Vector3d p_W = world.dynamics().X_WL(static_cast<int>(i)) * hand.links[i].p_LLcm;
    energy += hand.links[i].mass * kStandardGravity * p_W.z();
  }
  return energy;
}

struct Swing {
  double step, damping;
};
class SwingTest : public testing::TestWithParam<Swing> {};

// A body far away falls beside it; only the hand's energy is looked at.
TEST_P(SwingTest, EnergyStaysWithoutDampingAndNeverRisesWithIt) {
  Hand hand = MakePendulum();
  for (HandJoint& joint : hand.joints) {
    joint.drive = {0.0, GetParam().damping, 1e9};
  }
  GraspObject object = MakeBlock(1e-9);
  World world(hand, object, MakeConfig(GetParam().step));
  WorldState state;
  state.X_WH = MakePose(MakeRotationRpy(kPi / 2, 0.0, 0.0), Vector3d(0.0, 0.0, 1.0));
  state.q = Vector3d(0.3, 0.5, 0.4);
  state.u = Vector3d::Zero();
  state.p_WOcm = Vector3d(5.0, 0.0, 0.01);
  world.Reset(state);
  WorldCommand command;
  command.q = state.q;
  command.X_WH = state.X_WH;
  const auto energy = [&] { return world.CalcKineticEnergy() + CalcPotentialEnergy(hand, world); };
  const double start = energy();
  double highest = start, lowest = start, before = start, largest_kinetic = 0.0;
  for (double t = 0.0; t < 5.0; t += GetParam().step) {
    ASSERT_TRUE(world.Step(command).converged);
    largest_kinetic = std::max(largest_kinetic, world.CalcKineticEnergy());
    const double now = energy();
    highest = std::max(highest, now);
    lowest = std::min(lowest, now);
    if (GetParam().damping > 0.0) {
      ASSERT_LT(now, before + 1e-4 * largest_kinetic) << "at " << t;
    }
    before = now;
  }
  if (GetParam().damping == 0.0) {
    EXPECT_LT((highest - start) / largest_kinetic, 1e-3);
    EXPECT_LT((start - lowest) / largest_kinetic, 1e-3);
  }
  RecordProperty("drift", std::to_string((energy() - start) / largest_kinetic));
}

INSTANTIATE_TEST_SUITE_P(Steps, SwingTest,
                         testing::Values(Swing{0.0005, 0.0}, Swing{0.001, 0.0},
                                         Swing{0.002, 1e-4}));

// A load of known size moves a free body as Newton says, and its work is accounted for.
TEST(World, AnExternalLoadDoesItsWork) {
  BodyWorld body(MakeBlock(0.5), MakeConfig(0.002));
  body.state().gravity_W.setZero();
  body.state().p_WOcm = Vector3d(0.0, 0.0, 1.0);
  body.Start();
  const double I_xx = MakeBlock(0.5).mass_properties.I_OOcm(0, 0), t = 0.5;
  body.world().SetExternalLoad(Vector3d(0.0, 2.0, 0.0), Vector3d(1e-4, 0.0, 0.0));
  body.Run(250);
  EXPECT_NEAR(body.world().state().p_WOcm.y(), 0.5 * (2.0 / 0.5) * t * t, 1e-9);
  EXPECT_NEAR(body.world().state().w_WO.x(), 1e-4 / I_xx * t, 1e-6);
  const double work = 2.0 * 0.5 + 0.5 * 1e-4 * 1e-4 / I_xx * t * t;
  EXPECT_NEAR(body.world().energy().external, work, 1e-6);
  EXPECT_LT(std::abs(body.world().CalcEnergyResidual()), 1e-9);
  body.Start();
  body.Run(1);
  EXPECT_EQ(body.world().state().v_WOcm.norm(), 0.0);
}

}  // namespace
}  // namespace graspbench
