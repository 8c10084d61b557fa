#include "core/physics/imperfect_drive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "core/physics/implicit_world.h"
#include "core/physics/known_answers/small_scenes.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kStiffness = 2.0, kDamping = 0.04;  // N m/rad, N m s/rad
/** A torque that the solver may leave [N m]: its tolerance over a step of 1 ms. */
constexpr double kSolved = StepSolver::kTolerance / 0.001;

/** One rod of 50 mm about x. */
Hand MakeOneJoint() {
  Hand hand = MakeBareHand();
  AddRodLink(hand, 0, Pose::Identity(), Vector3d::UnitX(), 0.05, 0.05);
  hand.joints[0].drive = {kStiffness, kDamping, 10.0};
  return hand;
}

/** Without gravity; the object lies far away and weighs nothing. */
class Bench : public SmallWorld {
 public:
  explicit Bench(const Hand& hand, double step = 0.002)
      : SmallWorld(hand, MakeBlock(1e-9), MakeStepConfig(step)), step_(step) {
    start().gravity_W.setZero();
    start().p_WOcm = Vector3d(5.0, 0.0, 0.01);
    start().X_WH = MakePose(Vector3d(0.0, 0.0, 1.0));
    ApplyCoupling(hand, start().q);
    Reset();
  }
  /** Steps with q_cmd[0] = command(t) until `end`, showing the angle of joint 0 after each. */
  void Drive(double end, const std::function<double(double)>& command,
             const std::function<void(double t, double q)>& show = {}) {
    WorldCommand wanted{state().q, start().X_WH, Vector3d::Zero()};
    const auto num_steps = std::lround(end / step_);
    for (long i = 1; i <= num_steps; ++i) {
      const double t = static_cast<double>(i) * step_;
      wanted.q[0] = command(t);
      world().Step(wanted);
      if (show) show(t, state().q[0]);
    }
  }

 private:
  double step_;
};

// Back and forth so slowly that damping hardly counts: up and down lie `width` apart.
TEST(ImperfectDriveTest, TheLoopIsAsWideAsThePlay) {
  for (const double width : {0.0, 0.02, 0.07}) {
    Hand hand = MakeOneJoint();
    hand.joints[0].drive.hysteresis_width = width;
    Bench bench(hand);
    constexpr double kPeriod = 40.0, kSwing = 0.4;
    const double lag = kDamping / kStiffness * 4.0 * kSwing / kPeriod;  // of a ramp
    double up = kUnset, down = kUnset, highest = 0.0;
    bench.Drive(
        1.75 * kPeriod,
        [](double t) {
          const double phase = t / kPeriod - std::floor(t / kPeriod);
          return kSwing * (phase < 0.25   ? 4.0 * phase
                           : phase < 0.75 ? 2.0 - 4.0 * phase
                                          : 4.0 * phase - 4.0);
        },
        [&](double t, double q) {
          // The command passes zero at every half period.
          if (std::abs(t - 0.5 * kPeriod) < 1e-6) down = q;
          if (std::abs(t - kPeriod) < 1e-6) up = q;
          highest = std::max(highest, q);
        });
    EXPECT_NEAR(down - up, width + 2.0 * lag, 1e-5) << width;
    EXPECT_NEAR(highest, kSwing - 0.5 * width, 1.1 * lag + 1e-5) << width;
  }
}

/** How a joint follows a slow ramp. */
struct Jumps {
  std::vector<double> starts;   ///< lead of the command when the joint breaks loose [rad]
  std::vector<double> lengths;  ///< [rad]
};

Jumps FindJumps(const Hand& hand, double step, double speed, double end) {
  Bench bench(hand, step);
  Jumps jumps;
  double before = 0.0, from = 0.0;
  bool moves = false;
  bench.Drive(
      end, [&](double t) { return speed * t; },
      [&](double t, double q) {
        const bool now = (q - before) / step > 0.5 * kStribeckSpeed;
        if (now && !moves) {
          jumps.starts.push_back(speed * t - before);
          from = before;
        }
        if (!now && moves) jumps.lengths.push_back(q - from);
        moves = now;
        before = q;
      });
  return jumps;
}

// Sticks until the drive pulls with the breakaway torque, then jumps as the header says; and again.
TEST(ImperfectDriveTest, ASlowCommandSticksAndSlips) {
  constexpr double kBreak = 0.05, kSlide = 0.03, kSpeed = 0.003;  // N m, rad/s
  Hand hand = MakeOneJoint();
  JointDrive& drive = hand.joints[0].drive;
  drive.friction_static = kBreak;
  drive.friction_dynamic = kSlide;
  for (const double step : {0.0005, 0.001, 0.002}) {
    const Jumps jumps = FindJumps(hand, step, kSpeed, 20.0);
    ASSERT_GE(jumps.lengths.size(), 4u);
    const double yield = kBreak / kDriveBristleStiffness;  // before it breaks loose
    const double length = ((kBreak - kSlide) - kDamping * kStribeckSpeed) / kStiffness;
    EXPECT_NEAR(jumps.starts[0], kBreak / kStiffness, 1.5 * yield) << step;
    for (const double found : jumps.lengths) EXPECT_NEAR(found, length, 0.05 * length) << step;
    for (size_t i = 1; i < jumps.starts.size(); ++i) {
      EXPECT_NEAR(jumps.starts[i], kBreak / kStiffness, 0.05 * kBreak / kStiffness) << step;
    }
  }
}

TEST(ImperfectDriveTest, AFastCommandSlidesBehindByFrictionAndDamping) {
  constexpr double kBreak = 0.05, kSlide = 0.03, kSpeed = 0.5;
  Hand hand = MakeOneJoint();
  hand.joints[0].drive.friction_static = kBreak;
  hand.joints[0].drive.friction_dynamic = kSlide;
  Bench bench(hand);
  double lag = 0.0;
  bench.Drive(
      1.0, [](double t) { return kSpeed * t; }, [&](double t, double q) { lag = kSpeed * t - q; });
  EXPECT_NEAR(lag, (kSlide + kDamping * kSpeed) / kStiffness, 1e-6);
}

// Less than the breakaway torque holds a load for good; more does not.
TEST(ImperfectDriveTest, AHeldLoadStaysUpToTheBreakawayTorque) {
  constexpr double kBreak = 0.01;  // N m
  for (const double share : {0.95, 1.05}) {
    Hand hand = MakeOneJoint();
    hand.joints[0].drive = {0.0, 0.001, 10.0};
    hand.joints[0].drive.friction_static = kBreak;
    hand.joints[0].drive.friction_dynamic = 0.6 * kBreak;
    Bench bench(hand);
    // The rod stands along z: a pull along y has the moment m g l / 2 about x.
    const double g = share * kBreak / (0.05 * 0.025);
    bench.RampGravity(Vector3d(0.0, g, 0.0), 1.0);
    bench.Drive(2.0, [](double) { return 0.0; });
    const double moved = std::abs(bench.state().q[0]);
    if (share < 1.0) {
      EXPECT_NEAR(moved, share * kBreak / kDriveBristleStiffness, 1e-7);
    } else {
      EXPECT_GT(moved, 0.1);
    }
  }
}

// A loose joint that was pushed comes to rest, and by friction alone as far as its energy reaches.
TEST(ImperfectDriveTest, FrictionOnlyTakesEnergy) {
  constexpr double kSlide = 0.006, kSpeed = 20.0;
  for (const double step : {0.0005, 0.001, 0.002, 0.004}) {
    Hand hand = MakeOneJoint();
    hand.joints[0].drive = {0.0, 0.0, 10.0};
    hand.joints[0].drive.friction_static = 0.01;
    hand.joints[0].drive.friction_dynamic = kSlide;
    Bench bench(hand, step);
    bench.start().u[0] = kSpeed;
    bench.Reset();
    const double start = bench.world().CalcKineticEnergy();
    const double in_bristle = 0.5 * 0.01 * 0.01 / kDriveBristleStiffness;
    double before = start;
    bench.Drive(
        1.0, [](double) { return 0.0; },
        [&](double, double) {
          const double now = bench.world().CalcKineticEnergy();
          EXPECT_LE(now, before + in_bristle);
          before = now;
        });
    EXPECT_LT(before, in_bristle);
    const double expected = start / kSlide;
    EXPECT_NEAR(bench.state().q[0], expected, 0.02 * expected + step * kSpeed) << step;
    EXPECT_NEAR(bench.world().energy().drives, -start, 2.0 * in_bristle) << step;
  }
}

/** A finger of two coupled joints, driven at the first. */
Hand MakeCoupledFinger(CouplingRule rule, double compliance) {
  Hand hand = MakeOneJoint();
  AddRodLink(hand, 1, MakePose(Vector3d(0, 0, 0.05)), Vector3d::UnitX(), 0.03, 0.03);
  hand.joints[0].lower = hand.joints[1].lower = 0.0;
  hand.joints[0].upper = hand.joints[1].upper = 1.5;
  hand.joints[1].coupled_to = 0;
  hand.joints[1].coupling_compliance = compliance;
  hand.coupling = rule;
  return hand;
}

// A known moment turns the outer joint by compliance times moment from where its coupling has it.
TEST(ImperfectDriveTest, ACoupledJointYieldsByItsCompliance) {
  for (const CouplingRule rule : {CouplingRule::kEven, CouplingRule::kFixed}) {
    for (const double compliance : {0.05, 0.5, 5.0}) {
      const Hand hand = MakeCoupledFinger(rule, compliance);
      Bench bench(hand);
      bench.Drive(2.0, [](double) { return 0.5; });
      const double ratio = rule == CouplingRule::kEven ? 1.0 : hand.fixed_coupling_ratio;
      EXPECT_NEAR(bench.state().q[1], ratio * bench.state().q[0],
                  kSolved * (1.0 / kStiffness + compliance));
      // Across the outer link as it stands in the end, so the moment is found from that.
      bench.RampGravity(Vector3d(0.0, 4.0, 3.0), 1.0);
      bench.Drive(20.0, [](double) { return 0.5; });
      const double q0 = bench.state().q[0], q1 = bench.state().q[1];
      const Vector3d along(0.0, -std::sin(q0 + q1), std::cos(q0 + q1));
      const double moment = 0.03 * (0.015 * along).cross(Vector3d(0.0, 4.0, 3.0)).x();
      EXPECT_GT(std::abs(moment), 1e-4);
      EXPECT_NEAR(q1 - ratio * q0, compliance * moment, 1e-6 * compliance) << compliance;
      EXPECT_NEAR(bench.state().deviation[1], q1 - ratio * q0, 1e-9);
    }
  }
}

// Middle-first: the outer joint is not driven, yet a push bends it as its tendon gives way, and its
// stop at zero holds the other way.
TEST(ImperfectDriveTest, UnderMiddleFirstTheOuterJointYieldsOneWay) {
  for (const double pull : {4.0, -4.0}) {
    const Hand hand = MakeCoupledFinger(CouplingRule::kMiddleFirst, 5.0);
    Bench bench(hand);
    bench.RampGravity(Vector3d(0.0, pull, 0.0), 1.0);
    bench.Drive(20.0, [](double) { return 0.4; });
    const double q0 = bench.state().q[0], q1 = bench.state().q[1];
    const double moment = -0.03 * 0.015 * std::cos(q0 + q1) * pull;
    if (pull < 0.0) {
      EXPECT_NEAR(q1, 5.0 * moment, 1e-6);
    } else {
      EXPECT_NEAR(q1, moment / 200.0, 2e-5);  // the stop's stiffness
    }
  }
}

TEST(ImperfectDriveTest, YieldingCouplingsKeepTheEnergy) {
  for (const double step : {0.0005, 0.001}) {
    Hand hand = MakeCoupledFinger(CouplingRule::kEven, 2.0);
    for (HandJoint& joint : hand.joints) {
      joint.drive = {0.0, 0.0, 10.0};
      joint.lower = -100.0;
      joint.upper = 100.0;
    }
    Bench bench(hand, step);
    bench.start().gravity_W = Vector3d(0.0, 0.0, -kStandardGravity);
    bench.start().q << 1.0, 1.0;
    bench.Reset();
    const double start = bench.world().CalcKineticEnergy() + bench.CalcPotentialEnergy();
    double highest = start;
    bench.Drive(
        5.0, [](double) { return 0.0; },
        [&](double, double) {
          const double spring = 0.5 * bench.state().deviation[1] * bench.state().deviation[1] / 2.0;
          highest = std::max(
              highest, bench.world().CalcKineticEnergy() + bench.CalcPotentialEnergy() + spring);
        });
    EXPECT_LT(highest - start, 1e-5 * std::abs(start)) << step;
    EXPECT_LT(std::abs(bench.world().CalcEnergyResidual()), 1e-4 * std::abs(start)) << step;
  }
}

// A copy remembers hysteresis, friction and deviation.
TEST(ImperfectDriveTest, ACloneGoesOnToTheSameBits) {
  Hand hand = MakeCoupledFinger(CouplingRule::kFixed, 0.5);
  hand.joints[0].drive.hysteresis_width = 0.05;
  hand.joints[0].drive.friction_static = 0.02;
  hand.joints[0].drive.friction_dynamic = 0.01;
  Bench bench(hand);
  const auto command = [](double t) { return 0.3 * std::sin(9.0 * t); };
  bench.Drive(0.5, command);
  const std::unique_ptr<World> clone = bench.world().Clone();
  WorldCommand wanted{bench.state().q, bench.start().X_WH, Vector3d::Zero()};
  for (int i = 0; i < 200; ++i) {
    wanted.q[0] = command(0.5 + 0.002 * i);
    bench.world().Step(wanted);
    clone->Step(wanted);
  }
  EXPECT_EQ(clone->state().q, bench.state().q);
  EXPECT_EQ(clone->state().deviation, bench.state().deviation);
}

}  // namespace
}  // namespace graspbench
