#include "core/physics/carrying_arm.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/arm/load_arm.h"
#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "core/physics/implicit_world.h"
#include "core/physics/known_answers/small_scenes.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kUpper = 0.5, kFore = 0.4;            // lengths [m]
constexpr double kShoulder = 4000.0, kElbow = 2500.0;  // stiffnesses [N m/rad]
constexpr double kBall = 0.01;                         // radius of the hand [m]

/** Two links in the plane y = 0, a hand of one ball without friction at the end. */
class TwoLinks {
 public:
  TwoLinks() {
    auto arm = std::make_shared<Arm>();
    for (const auto& [length, stiffness] :
         {std::pair(kUpper, kShoulder), std::pair(kFore, kElbow)}) {
      ArmJoint joint;
      joint.name = arm->joints.empty() ? "shoulder" : "elbow";
      joint.a = length;
      joint.lower = -4.0;
      joint.upper = 4.0;
      joint.torque = 1000.0;
      joint.stiffness = stiffness;
      joint.armature = 0.05;
      joint.mass = 2.0;
      joint.p_com = Vector3d(-0.5 * length, 0.0, 0.0);
      joint.inertia = Vector3d(0.001, 0.04, 0.04);
      arm->joints.push_back(joint);
    }
    mounted.arm = arm;
    // The joints' axes along -y of the world, so that an angle raises its link.
    mounted.X_WB = MakePose(MakeRotationRpy(0.5 * kPi, 0.0, 0.0), Vector3d(0.0, 0.0, 0.0));
  }

  /** With the ball's lowest point so far in the table. */
  void Lower(const VectorXd& q, double depth) {
    mounted.X_WB.translation().z() = 0.0;
    const double z = (mounted.X_WB * CalcFlangePose(*mounted.arm, q)).translation().z();
    mounted.X_WB.translation().z() = kBall - depth - z;
  }

  static Hand MakeBall() {
    Hand hand = MakeBareHand();
    hand.links[0].mass = 1.0;
    hand.links[0].I_LLcm = 1e-3 * Eigen::Matrix3d::Identity();
    hand.contact_spheres.push_back({0, Vector3d::Zero(), kBall});
    hand.links[0].surface.friction_static = hand.links[0].surface.friction_dynamic = 0.0;
    return hand;
  }

  MountedArm mounted;
};

class CarriedBall : public SmallWorld {
 public:
  CarriedBall(const MountedArm& mounted, const VectorXd& q, const SimConfig& config)
      : SmallWorld(TwoLinks::MakeBall(), MakeBlock(0.1), config) {
    start().p_WOcm = Vector3d(5.0, 0.0, 0.05);
    SetArm(mounted, q, start());
    Reset();
  }
};

/** C_zz of two links in closed form: each joint's lever is its distance from the hand along x. */
double CalcCompliance(const VectorXd& q) {
  const double of_fore = kFore * std::cos(q[0] + q[1]);
  const double of_both = kUpper * std::cos(q[0]) + of_fore;
  return of_both * of_both / kShoulder + of_fore * of_fore / kElbow;
}

TEST(CarryingArm, TwoLinksPressOnTheTableByTheirJoints) {
  for (const Eigen::Vector2d& q : {Eigen::Vector2d(0.9, -1.4), Eigen::Vector2d(-0.3, -0.7)}) {
    TwoLinks arm;
    constexpr double kDepth = 2e-4;
    arm.Lower(q, kDepth);
    const SimConfig config;
    const double force = kDepth / (CalcCompliance(q) + 1.0 / config.contact_stiffness);
    CarriedBall world(arm.mounted, q, config);
    const StepReport report = world.Run(2.0);
    // The deflection changes the levers by some 1e-3 of themselves.
    EXPECT_NEAR(world.state().X_WH.translation().z(), kBall - force / config.contact_stiffness,
                3e-3 * kDepth);
    const double shoulder = force * (kUpper * std::cos(q[0]) + kFore * std::cos(q[0] + q[1]));
    EXPECT_NEAR(kShoulder * (world.state().q_arm[0] - q[0]), shoulder, 3e-3 * shoulder);
    EXPECT_EQ(world.num_unconverged(), 0);
    EXPECT_LT(std::abs(world.world().CalcEnergyResidual()), 1e-6);
    EXPECT_GE(report.arm_joint, 0);
  }
}

/** Stretched and upright the arm has lost the vertical: its joints cannot yield to the table. */
TEST(CarryingArm, LostDirectionIsStiff) {
  const Eigen::Vector2d q(-0.5 * kPi, 0.0);
  EXPECT_LT(CalcCompliance(q), 1e-30);
  TwoLinks arm;
  constexpr double kDepth = 1e-4;
  arm.Lower(q, kDepth);
  CarriedBall world(arm.mounted, q, SimConfig());
  world.Run(1.0);
  EXPECT_NEAR(world.state().X_WH.translation().z(), kBall - kDepth, 1e-9);
  // Bent a little it yields by its levers.
  const Eigen::Vector2d bent(-0.5 * kPi, 0.3);
  arm.Lower(bent, kDepth);
  CarriedBall other(arm.mounted, bent, SimConfig());
  other.Run(1.0);
  EXPECT_GT(other.state().X_WH.translation().z(), kBall - 0.9 * kDepth);
}

/** Springs of the joints and both motions [J]. */
double CalcEnergy(CarriedBall& world, const MountedArm& mounted, const VectorXd& q_command) {
  const WorldState& state = world.state();
  double energy = world.world().CalcKineticEnergy();
  energy +=
      0.5 * state.u_arm.dot(CalcArmMass(*mounted.arm, CalcArmPoses(*mounted.arm, state.q_arm)) *
                            state.u_arm);
  for (int i = 0; i < 2; ++i) {
    energy += 0.5 * mounted.arm->joints[static_cast<size_t>(i)].stiffness *
              std::pow(q_command[i] - state.q_arm[i], 2);
  }
  return energy;
}

TEST(CarryingArm, EnergyOfASwingDoesNotGrow) {
  const Eigen::Vector2d q(0.9, -1.4);
  for (const double damping_time : {0.0, 0.005}) {
    TwoLinks arm;
    arm.mounted.X_WB.translation().z() = 1.0;
    SimConfig config = MakeStepConfig(2e-5);
    config.arm_damping_time = damping_time;
    CarriedBall world(arm.mounted, q + Eigen::Vector2d(0.002, -0.004), config);
    world.start().gravity_W.setZero();  // the block stays where it is
    world.Reset();
    WorldCommand command;
    command.X_WH = arm.mounted.X_WB * CalcFlangePose(*arm.mounted.arm, q);
    const double start = CalcEnergy(world, arm.mounted, q);
    double before = start;
    for (int i = 0; i < 50; ++i) {
      for (int step = 0; step < 100; ++step) world.world().Step(command);
      const double now = CalcEnergy(world, arm.mounted, q);
      EXPECT_LE(now, before * (1.0 + 1e-3)) << i;
      before = now;
    }
    EXPECT_GT(start, 0.01);
    EXPECT_LT(before, (damping_time > 0.0 ? 0.05 : 1.001) * start);
    // Taken at the step's end a spring damps by h / 2 times its stiffness: some 1 % here.
    EXPECT_GT(before, (damping_time > 0.0 ? 0.0 : 0.98) * start);
    EXPECT_LT(std::abs(world.world().CalcEnergyResidual()), 1e-5);
  }
}

/** What touches nothing is where it is commanded to be, along any path. */
TEST(CarryingArm, FreeHandFollowsItsCommand) {
  for (const char* id : {"puma560", "pa10"}) {
    MountedArm mounted;
    mounted.arm = std::make_shared<const Arm>(LoadArm(id));
    mounted.X_WB.translation().x() = -0.5;
    SimConfig config;
    SmallWorld world(TwoLinks::MakeBall(), MakeBlock(0.1), config);
    world.start().p_WOcm = Vector3d(5.0, 0.0, 0.05);
    SetArm(mounted, mounted.arm->ready, world.start());
    world.Reset();
    WorldCommand command;
    const Pose X_WStart = world.state().X_WH;
    double worst = 0.0;
    for (int i = 1; i <= 500; ++i) {
      const double t = 0.002 * i;  // x = a t^2 / 2 along a line
      command.X_WH = X_WStart;
      command.X_WH.pretranslate(0.05 * t * t * Vector3d(0.6, 0.0, 0.8));
      command.v_WH = 0.1 * t * Vector3d(0.6, 0.0, 0.8);
      const StepReport report = world.world().Step(command);
      EXPECT_TRUE(report.is_followed);
      worst =
          std::max(worst, (world.state().X_WH.translation() - command.X_WH.translation()).norm());
    }
    EXPECT_LT(worst, 2e-6) << id;
    EXPECT_LT(std::abs(world.world().CalcEnergyResidual()), 1e-6) << id;
  }
}

TEST(CarryingArm, PoseOutOfReachIsNotFollowed) {
  MountedArm mounted;
  mounted.arm = std::make_shared<const Arm>(LoadArm("puma560"));
  SmallWorld world(TwoLinks::MakeBall(), MakeBlock(0.1), SimConfig());
  world.start().p_WOcm = Vector3d(5.0, 0.0, 0.05);
  SetArm(mounted, mounted.arm->ready, world.start());
  world.Reset();
  WorldCommand command;
  command.X_WH = world.state().X_WH;
  EXPECT_TRUE(world.world().Step(command).is_followed);
  command.X_WH.pretranslate(Vector3d(3.0, 0.0, 0.0));
  EXPECT_FALSE(world.world().Step(command).is_followed);
}

/** A weak shoulder cannot hold the weight of arm and hand, and says so. */
TEST(CarryingArm, WeightCountsTowardsTheLimit) {
  const Eigen::Vector2d q(0.0, 0.0);
  TwoLinks arm;
  arm.mounted.X_WB.translation().z() = 1.0;
  CarriedBall held(arm.mounted, q, SimConfig());
  const double weight = kStandardGravity * (2.0 * 0.25 + 2.0 * 0.7 + 1.0 * 0.9);
  const StepReport report = held.Run(0.1);
  EXPECT_EQ(report.arm_joint, 0);
  EXPECT_NEAR(report.arm_torque_share, weight / 1000.0, 1e-9);
  auto weak = std::make_shared<Arm>(*arm.mounted.arm);
  weak->joints[0].torque = 0.9 * weight;
  arm.mounted.arm = weak;
  CarriedBall sags(arm.mounted, q, SimConfig());
  EXPECT_NEAR(sags.Run(0.1).arm_torque_share, 1.0, 1e-9);
  EXPECT_LT(sags.state().q_arm[0], -0.001);
}

TEST(CarryingArm, HandWithTooManyJointsOnAnArmIsRefused) {
  const Hand shadow = LoadHand("shadow");
  DemandShortChains(shadow, 7);
  try {
    DemandShortChains(shadow, 16);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("on an arm with 16"), std::string::npos);
  }
}

}  // namespace
}  // namespace graspbench
