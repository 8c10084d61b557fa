#include "core/physics/soft_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/physics/known_answers/small_scenes.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kForce = 0.7;      // of each fingertip [N]
constexpr double kHalfGap = 0.034;  // of the squeezed body, that of the paper ball [m]
constexpr double kSpacing = 0.8 * kReferenceRadius;  // of balls along a finger

Compressibility MakeCompressible(double yield) {
  return {kForce, yield * Eigen::Matrix3d::Identity(), false};
}

std::vector<PressingBall> MakeRow(int num_balls, double spacing, double depth) {
  std::vector<PressingBall> balls;
  for (int i = 0; i < num_balls; ++i) {
    balls.push_back({Vector3d(i * spacing, 0.0, kReferenceRadius - depth), Vector3d::UnitZ(),
                     kReferenceRadius, depth});
  }
  return balls;
}

double CalcForce(const Compressibility& object, const std::vector<PressingBall>& balls) {
  std::vector<SurfaceYield> yields;
  CalcSurfaceYields(object, balls, yields);
  double force = 0.0;
  for (size_t i = 0; i < balls.size(); ++i) {
    force += yields[i].factor * balls[i].depth * balls[i].depth;
  }
  return force;
}

/** The pressure of the bed under the balls, summed over a fine grid [N]. */
double SumPressure(const Compressibility& object, const std::vector<PressingBall>& balls) {
  constexpr double kCell = 1e-4, kReach = 0.04;
  double volume = 0.0;
  for (double x = -kReach; x < kReach; x += kCell) {
    for (double y = -kReach; y < kReach; y += kCell) {
      double deepest = 0.0;
      for (const PressingBall& ball : balls) {
        const double away = std::hypot(x - ball.p_OCentre.x(), y - ball.p_OCentre.y());
        if (away >= ball.radius) continue;
        const double lowest =
            ball.p_OCentre.z() - std::sqrt(ball.radius * ball.radius - away * away);
        deepest = std::max(deepest, -lowest);
      }
      volume += deepest * kCell * kCell;
    }
  }
  return volume * CalcStiffnessPerVolume(object, Vector3d::UnitZ());
}

// The one known figure: a fingertip with the force goes down by half of what the size loses.
TEST(SoftSurface, TheReferenceFingertipGoesDownByTheYield) {
  for (const double yield : {0.00075, 0.0015, 0.005, 0.008}) {
    const Compressibility object = MakeCompressible(yield);
    EXPECT_NEAR(CalcForce(object, MakeRow(1, 0.0, yield)), kForce, 1e-12);
    EXPECT_NEAR(SumPressure(object, MakeRow(1, 0.0, yield)), kForce, 0.003 * kForce);
  }
}

TEST(SoftSurface, YieldsByTheDirectionOfTheSurface) {
  Compressibility object = {kForce, Vector3d(0.002, 0.005, 0.0).asDiagonal(), false};
  const auto expected = [](double yield) { return kForce / CalcDisplacedVolume(0.007, yield); };
  EXPECT_EQ(CalcStiffnessPerVolume(object, Vector3d::UnitX()), expected(0.002));
  EXPECT_EQ(CalcStiffnessPerVolume(object, -Vector3d::UnitY()), expected(0.005));
  EXPECT_NEAR(CalcStiffnessPerVolume(object, Vector3d(1.0, 1.0, 0.0).normalized()),
              expected(0.0035), 1e-6 * expected(0.0035));
  EXPECT_TRUE(std::isinf(CalcStiffnessPerVolume(object, Vector3d::UnitZ())));
  std::vector<SurfaceYield> yields;
  CalcSurfaceYields(object, MakeRow(1, 0.0, 0.001), yields);
  EXPECT_EQ(yields[0].factor, 0.0);  // rigid
}

// Balls side by side, deep in one another, at different depths, and one that others hide.
TEST(SoftSurface, BallsShareTheBed) {
  for (const double yield : {0.00075, 0.005}) {
    const Compressibility object = MakeCompressible(yield);
    for (const double share : {0.3, 1.0, 1.6}) {
      for (const int num_balls : {2, 5}) {
        std::vector<PressingBall> balls = MakeRow(num_balls, kSpacing, share * yield);
        for (PressingBall& ball : balls) ball.p_OCentre.x() -= 0.01;
        for (const bool is_tilted : {false, true}) {
          for (int i = 0; is_tilted && i < num_balls; ++i) {
            balls[i].depth -= 0.1 * i * share * yield;
            balls[i].p_OCentre.z() = kReferenceRadius - balls[i].depth;
          }
          const double expected = SumPressure(object, balls);
          EXPECT_NEAR(CalcForce(object, balls), expected, 0.01 * expected)
              << yield << ' ' << share << ' ' << num_balls << ' ' << is_tilted;
        }
      }
    }
    const std::vector<PressingBall> one = MakeRow(1, 0.0, yield), same = MakeRow(4, 0.0, yield);
    EXPECT_NEAR(CalcForce(object, same), CalcForce(object, one), 1e-3 * kForce);
  }
  // From opposite sides nothing is shared.
  std::vector<PressingBall> opposed = MakeRow(2, 0.0, 0.005);
  opposed[1].nhat_O = -Vector3d::UnitZ();
  EXPECT_NEAR(CalcForce(MakeCompressible(0.005), opposed), 2.0 * kForce, 1e-9);
}

/** Between two rows of balls that press with the force, of a body as thick as `sight` [m]. */
double FindWidth(double sight, double grasp, int num_balls, double spacing) {
  const Compressibility object = MakeCompressible(0.5 * (sight - grasp));
  double low = 0.0, high = kMostYield * 0.5 * (sight - grasp);
  for (int i = 0; i < 60; ++i) {
    const double depth = 0.5 * (low + high);
    (CalcForce(object, MakeRow(num_balls, spacing, depth)) < kForce ? low : high) = depth;
  }
  return sight - 2.0 * high;
}

// The widths of the catalogue between digits that lie flat, a phalanx of 22 mm of balls each.
TEST(SoftSurface, HalfAsManyPointsOnADigitLeaveTheWidth) {
  const double sizes[][2] = {{0.072, 0.068}, {0.068, 0.058},  {0.062, 0.046},
                             {0.028, 0.025}, {0.032, 0.0305}, {0.024, 0.022}};
  for (const auto& [sight, grasp] : sizes) {
    const double all = FindWidth(sight, grasp, 5, kSpacing);
    const double half = FindWidth(sight, grasp, 3, 2.0 * kSpacing);
    EXPECT_LE(std::abs(half - all), 0.02 * all) << sight;
    EXPECT_NEAR(FindWidth(sight, grasp, 1, 0.0), grasp, 1e-9);
  }
}

// x = y + y_pad + F / k, with each part as its own law has it; the slope by differences.
TEST(CalcCompression, SurfacePadAndSpringShareTheDepth) {
  for (const double hertz : {0.0, 1.6e5}) {
    for (const SurfaceYield surface : {SurfaceYield{3e4, 0.01}, SurfaceYield{1e6, 0.003},
                                       SurfaceYield{1e9, 0.0005}, SurfaceYield{1e9, 0.1}}) {
      ContactPoint contact;
      contact.material.stiffness = 1e5;
      contact.material.pad = {hertz > 0.0 ? 1.5e6 : 0.0, 0.003};
      contact.hertz = hertz;
      contact.surface = surface;
      EXPECT_EQ(CalcCompression(contact, -1e-4).force, 0.0);
      for (double x = 1e-7; x < 0.03; x *= 1.3) {
        const PadCompression at = CalcCompression(contact, x);
        const double free = std::sqrt(at.force / surface.factor);
        EXPECT_NEAR(at.surface, std::min(free, surface.depth), 1e-6 * x);
        const double pad =
            hertz > 0.0 ? std::min(std::pow(at.force / hertz, 2.0 / 3.0), 0.003) : 0.0;
        EXPECT_NEAR(at.compression, pad, 1e-6 * x);
        EXPECT_NEAR(at.surface + at.compression + at.force / 1e5, x, 1e-6 * x);
        const double step = 1e-5 * x;
        const double slope =
            (CalcCompression(contact, x + step).force - CalcCompression(contact, x - step).force) /
            (2.0 * step);
        EXPECT_NEAR(at.slope, slope, 1e-3 * slope) << x;
      }
    }
  }
}

/** Three fingertips of the reference radius around a body with three flat sides. */
class ThreeFingertips {
 public:
  explicit ThreeFingertips(double yield, double force = kForce, double step = 0.002)
      : world_(MakeHand(force), MakeBody(yield), MakeStepConfig(step)) {
    world_.start().X_WH = MakePose(Vector3d(0.0, 0.0, 1.0 + kSqueezeLever));
    world_.start().p_WOcm = Vector3d(0.0, 0.0, 1.0);
    world_.start().gravity_W.setZero();
    world_.Reset(Eigen::VectorXd::Ones(3));
    report_ = world_.Run(1.0);
    world_.world().FindHandContacts(contacts_);
  }

  /** The mean width between a fingertip and the like on the opposite side [m]. */
  double CalcWidth() const {
    double width = 0.0;
    for (const HandContact& contact : contacts_) {
      width += 2.0 * (contact.p_WC - world_.state().p_WOcm).head<2>().norm() / 3.0;
    }
    return width;
  }
  SmallWorld& world() { return world_; }
  const StepReport& report() const { return report_; }
  const std::vector<HandContact>& contacts() const { return contacts_; }

 private:
  static Hand MakeHand(double force) {
    Hand hand = MakeSqueezeHand(3, kHalfGap, force, 0.0);
    for (ContactSphere& sphere : hand.contact_spheres) {
      const Vector3d outwards = Vector3d(sphere.p_LS.x(), sphere.p_LS.y(), 0.0).normalized();
      sphere.p_LS -= (sphere.radius - kReferenceRadius) * outwards;
      sphere.radius = kReferenceRadius;
    }
    return hand;
  }
  static GraspObject MakeBody(double yield) {
    GraspObject body = MakeSolid(MakePrism(3, kHalfGap, 0.06), 0.005, 0.7, 0.7);
    if (yield > 0.0) body.compressible = MakeCompressible(yield);
    return body;
  }

  SmallWorld world_;
  StepReport report_;
  std::vector<HandContact> contacts_;
};

TEST(SoftSurface, ThreeFingertipsHoldTheSizeOfGrasp) {
  constexpr double kYield = 0.005;
  double at_2_ms = 0.0;
  for (const double step : {0.002, 0.004, 0.001, 0.0005}) {
    ThreeFingertips scene(kYield, kForce, step);
    ASSERT_EQ(scene.contacts().size(), 3u);
    double force = 0.0;
    for (const HandContact& contact : scene.contacts()) force += contact.normal_force / 3.0;
    // As the surface yields, a finger turns and its lever changes a little.
    EXPECT_NEAR(force, kForce, 0.01 * kForce);
    EXPECT_NEAR(scene.CalcWidth(), 2.0 * (kHalfGap - kYield), 1e-4);
    EXPECT_EQ(scene.world().num_unconverged(), 0);
    if (at_2_ms == 0.0) at_2_ms = scene.CalcWidth();
    EXPECT_NEAR(scene.CalcWidth(), at_2_ms, 1e-6) << step;
    EXPECT_LT(scene.report().worst_penetration, 1e-4);  // nothing sinks through
    // The body stays in the hand: the fingertips carry it up on their arcs, and nothing counts as
    // reseated.
    const double rise = kYield * kYield / (2.0 * kSqueezeLever);
    EXPECT_LT((scene.world().state().p_WOcm - Vector3d(0.0, 0.0, 1.0 + rise)).norm(), 1e-5);
    EXPECT_LT(std::abs(scene.world().world().CalcEnergyResidual()), 1e-5);
  }
}

// From twice the yield on the surface is a rigid one.
TEST(SoftSurface, NothingSinksThrough) {
  for (const double force : {0.7, 3.0, 10.0}) {
    ThreeFingertips scene(0.005, force);
    EXPECT_LT(scene.report().worst_penetration, 1e-4 + force / 1e5) << force;
    EXPECT_GE(scene.CalcWidth(), 2.0 * (kHalfGap - kMostYield * 0.005) - 4e-4) << force;
  }
}

// What is no compressible object and what yields nowhere are the same to the last bit.
TEST(SoftSurface, WhatYieldsNowhereIsRigid) {
  ThreeFingertips rigid(0.0), never(1e-9);
  EXPECT_EQ(rigid.world().state().q, never.world().state().q);
  EXPECT_EQ(rigid.world().state().p_WOcm, never.world().state().p_WOcm);
  EXPECT_EQ(rigid.report().worst_penetration, never.report().worst_penetration);
}

// Overlap at a start counts from the surface at rest, whatever would give way.
TEST(SoftSurface, GapsAreThoseAtRest) {
  ThreeFingertips soft(0.005);
  SmallWorld& world = soft.world();
  world.world().dynamics().UpdatePositions(world.state().X_WH, world.state().q);
  const double gap = world.world().collider().CalcSmallestGap(world.world().dynamics(),
                                                              world.world().CalcObjectPose());
  EXPECT_NEAR(gap, -0.005, 1e-4);
}

// Balls press to different depths and release in another order, so that their shares change on a
// path that encloses an area. By the law alone the cycle returns what it took; in a world damping
// takes more than the rest (ABounceLosesEnergy).
TEST(SoftSurface, PressingAndReleasingGainsNothing) {
  constexpr int kNumSteps = 1600;
  for (const double yield : {0.00075, 0.005}) {
    const Compressibility object = MakeCompressible(yield);
    for (const int num_balls : {2, 4}) {
      double work = 0.0, most = 0.0;  // of the balls on the surface [J]
      std::vector<PressingBall> balls = MakeRow(num_balls, kSpacing, 0.0);
      std::vector<SurfaceYield> yields;
      const auto depth_at = [&](int ball, double t) {
        const double phase = std::clamp(1.25 * t - 0.25 * ball / (num_balls - 1), 0.0, 1.0);
        const double bent = ball % 2 == 0 ? phase * phase : phase;
        return (1.2 - 0.3 * ball) * yield * (phase < 1.0 ? std::sin(kPi * bent) : 0.0);
      };
      for (int k = 0; k < kNumSteps; ++k) {
        for (int i = 0; i < num_balls; ++i) {
          balls[i].depth = depth_at(i, (k + 0.5) / kNumSteps);
          balls[i].p_OCentre.z() = kReferenceRadius - balls[i].depth;
        }
        CalcSurfaceYields(object, balls, yields);
        for (int i = 0; i < num_balls; ++i) {
          const double move =
              depth_at(i, (k + 1.0) / kNumSteps) - depth_at(i, (k + 0.0) / kNumSteps);
          work += yields[i].factor * balls[i].depth * balls[i].depth * move;
        }
        most = std::max(most, work);
      }
      EXPECT_GT(most, 1e-4);
      EXPECT_NEAR(work, 0.0, 5e-4 * most) << yield << ' ' << num_balls;
    }
  }
}

// Dropped on three balls it comes back lower, and no energy is without a cause.
TEST(SoftSurface, ABounceLosesEnergy) {
  Hand hand = MakeBareHand();
  for (int i = 0; i < 3; ++i) {
    const double angle = 2.0 * kPi * i / 3.0;
    hand.contact_spheres.push_back(
        {0, 0.01 * Vector3d(std::cos(angle), std::sin(angle), 0.0), kReferenceRadius});
  }
  for (const double step : {0.004, 0.002, 0.001}) {
    GraspObject block = MakeBlock(0.005);
    block.compressible = MakeCompressible(0.002);
    constexpr double kDrop = 0.02;
    SmallWorld world(hand, block, MakeStepConfig(step));
    world.start().X_WH = MakePose(Vector3d(0.0, 0.0, 1.0));
    world.start().p_WOcm = Vector3d(0.0, 0.0, 1.0 + kReferenceRadius + 0.01 + kDrop);
    world.Reset();
    double lowest = kDrop, rebound = 0.0;
    for (int i = 0; i * step < 0.5; ++i) {
      world.Step();
      const double height = world.state().p_WOcm.z() - (1.0 + kReferenceRadius + 0.01);
      lowest = std::min(lowest, height);
      if (world.state().v_WOcm.z() > 0.0) rebound = std::max(rebound, height);
    }
    EXPECT_LT(lowest, -1e-4);
    EXPECT_LT(rebound, 0.5 * kDrop);
    EXPECT_LT(world.world().energy().contacts, 0.0);
    EXPECT_LT(std::abs(world.world().CalcEnergyResidual()), 1e-5);
  }
}

}  // namespace
}  // namespace graspbench
