#include "core/trial/grip/grip_statics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/physics/known_answers/small_scenes.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

PartLoad MakeLoad(const Vector3d& push_W) {
  PartLoad load;
  load.force = 1.0;
  load.push_W = push_W;
  return load;
}

TEST(BalanceForces, AThumbBearsTheSumOfWhatOpposesIt) {
  const std::vector<PartLoad> loads = {MakeLoad(Vector3d::UnitX()), MakeLoad(-Vector3d::UnitX()),
                                       MakeLoad(-Vector3d::UnitX()), MakeLoad(Vector3d::Zero())};
  std::vector<double> forces = {0.0, 0.7, 0.7, 0.0};
  BalanceForces(loads, {0}, forces);
  EXPECT_NEAR(forces[0], 1.4, 1e-12);
}

// Against brute force over a grid: the least square of what is left.
TEST(BalanceForces, NoOtherForcesLeaveLess) {
  RandomStream random("balance", "test");
  const auto draw = [&] {
    return Vector3d(random.NextNormal(), random.NextNormal(), random.NextNormal()).normalized();
  };
  for (int i = 0; i < 50; ++i) {
    const std::vector<PartLoad> loads = {MakeLoad(draw()), MakeLoad(draw()), MakeLoad(draw()),
                                         MakeLoad(draw())};
    std::vector<double> forces = {0.0, 1.3, 0.6, 0.0};
    BalanceForces(loads, {0, 3}, forces);
    const auto calc_left = [&](double thumb, double palm) {
      return (thumb * loads[0].push_W + 1.3 * loads[1].push_W + 0.6 * loads[2].push_W +
              palm * loads[3].push_W)
          .norm();
    };
    ASSERT_GE(forces[0], 0.0);
    ASSERT_GE(forces[3], 0.0);
    const double left = calc_left(forces[0], forces[3]);
    for (double thumb = 0.0; thumb <= 4.0; thumb += 0.1) {
      for (double palm = 0.0; palm <= 4.0; palm += 0.1) {
        EXPECT_LE(left, calc_left(thumb, palm) + 1e-9);
      }
    }
  }
}

// What contacts push along the sides counts, what they bear of the weight does not.
TEST(CalcPartLoads, WhatBearsTheWeightIsNoPush) {
  Hand hand = MakeBareHand();
  AddRodLink(hand, 0, Pose::Identity(), Vector3d::UnitY(), 0.02, 0.1);
  HandDynamics dynamics(hand);
  dynamics.UpdatePositions(Pose::Identity(), Eigen::VectorXd::Zero(1));
  HandContact contact;
  contact.link = 1;
  contact.nhat_W = Vector3d::UnitX();
  contact.normal_force = 2.0;
  contact.friction_W = Vector3d(0.0, 0.5, 0.8);
  const Vector3d down_W(0.0, 0.0, -9.8);
  const PartLoad load = CalcPartLoads({contact}, {1, 0}, 2, dynamics, down_W)[0];
  EXPECT_LE((load.push_W - Vector3d(1.0, 0.25, 0.0)).norm(), 1e-12);
  const PartLoad afloat = CalcPartLoads({contact}, {1, 0}, 2, dynamics, Vector3d::Zero())[0];
  EXPECT_LE((afloat.push_W - Vector3d(1.0, 0.25, 0.4)).norm(), 1e-12);
  contact.nhat_W = Vector3d(0.6, 0.0, 0.8);  // below the widest place of a ball
  const PartLoad below = CalcPartLoads({contact}, {1, 0}, 2, dynamics, down_W)[0];
  EXPECT_LE((below.push_W - Vector3d(0.6, 0.25, 0.0)).norm(), 1e-12);
}

// A rod of 0.1 m hangs on a drive of 2 N m/rad; its tip is held fixed. Asked to turn by 1 rad it
// presses with k / length.
TEST(ClosingStiffness, OfOneRodInClosedForm) {
  Hand hand = MakeBareHand();
  AddRodLink(hand, 0, Pose::Identity(), Vector3d::UnitY(), 0.02, 0.1);
  hand.joints.back().drive = {2.0, 0.02, 100.0};
  HandDynamics dynamics(hand);
  dynamics.UpdatePositions(Pose::Identity(), Eigen::VectorXd::Zero(1));
  HandContact contact;
  contact.link = 1;
  contact.p_WC = Vector3d(0.0, 0.0, 0.1);
  contact.nhat_W = Vector3d::UnitX();
  contact.normal_force = 3.0;
  const std::vector<PartLoad> loads =
      CalcPartLoads({contact}, {1, 0}, 2, dynamics, Vector3d::Zero());
  EXPECT_NEAR(loads[0].force, 3.0, 1e-12);
  EXPECT_NEAR(loads[0].torque[0], 0.1, 1e-12);
  EXPECT_EQ(loads[1].force, 0.0);
  EXPECT_NEAR(CalcClosingStiffness(hand, dynamics, loads[0], Eigen::VectorXd::Constant(1, 1.0)),
              2.0 / 0.1, 1e-9);
  EXPECT_EQ(CalcClosingStiffness(hand, dynamics, loads[0], Eigen::VectorXd::Constant(1, -1.0)),
            kLeastStiffness);
}

struct Scene {
  Hand hand = MakeBareHand();
  Grasp grasp;

  /** A rod of 0.1 m with balls of 5 mm at its middle and its end. */
  void AddDigit(const std::string& id, double torque_limit) {
    AddRodLink(hand, 0, Pose::Identity(), Vector3d::UnitY(), 0.02, 0.1);
    hand.joints.back().drive = {1.0, 0.02, torque_limit};
    Digit digit;
    digit.id = id;
    digit.is_thumb = id == "TH";
    digit.links = {static_cast<int>(hand.links.size()) - 1};
    digit.distal_link = digit.links.front();
    digit.p_LPad = Vector3d(0.0, 0.0, 0.1);
    for (const double z : {0.05, 0.1}) {
      hand.contact_spheres.push_back({digit.distal_link, Vector3d(0.0, 0.0, z), 0.005});
    }
    hand.digits.push_back(digit);
    grasp.digits.push_back(id);
    grasp.q_pre = Eigen::VectorXd::Zero(hand.num_joints());
    grasp.q_target = Eigen::VectorXd::Constant(hand.num_joints(), 0.3);
  }
};

// Rods of 0.1 m, drives of 2 N m: at the pad torque over length, anywhere torque over the shortest
// lever, 0.05 m.
TEST(GripLimit, OfRodsIsTorqueOverLever) {
  Scene scene;
  scene.AddDigit("TH", 2.0);
  scene.AddDigit("FF", 2.0);
  EXPECT_NEAR(CalcPadGrip(scene.hand, scene.grasp), 2.0 / 0.1, 1e-9);
  EXPECT_NEAR(CalcGripBound(scene.hand, scene.grasp), 2.0 / 0.05, 1e-9);
  scene.hand.contact_spheres.front().p_LS.z() = 0.001;  // on the joint: its radius is the lever
  EXPECT_NEAR(CalcGripBound(scene.hand, scene.grasp), 2.0 / 0.05, 1e-9) << "of the finger";
  scene.hand.contact_spheres[2].p_LS.z() = 0.001;
  EXPECT_NEAR(CalcGripBound(scene.hand, scene.grasp), 2.0 / 0.005, 1e-9);
  scene.grasp.q_target.setZero();  // nothing closes
  EXPECT_TRUE(std::isinf(CalcPadGrip(scene.hand, scene.grasp)));
  EXPECT_TRUE(std::isinf(CalcGripBound(scene.hand, scene.grasp)));
}

// A weak thumb bears the sum of what opposes it; a palm would bear it, too.
TEST(GripLimit, TheOpposingDigitBearsTheOthers) {
  Scene scene;
  scene.AddDigit("TH", 0.5);
  scene.AddDigit("FF", 2.0);
  EXPECT_NEAR(CalcPadGrip(scene.hand, scene.grasp), 0.5 / 0.1, 1e-9);
  EXPECT_NEAR(CalcGripBound(scene.hand, scene.grasp), 0.5 / 0.05, 1e-9);
  scene.AddDigit("MF", 2.0);
  EXPECT_NEAR(CalcPadGrip(scene.hand, scene.grasp), 0.5 / 0.1 / 2.0, 1e-9);
  EXPECT_NEAR(CalcGripBound(scene.hand, scene.grasp), 2.0 / 0.05, 1e-9) << "they may oppose too";
  scene.grasp.palm_may_touch = true;
  EXPECT_NEAR(CalcPadGrip(scene.hand, scene.grasp), 2.0 / 0.1, 1e-9);
}

// Two joints in a row, 0.1 m each: the sum of what each can give on its own link.
TEST(GripLimit, JointsOfADigitAddUp) {
  Scene scene;
  scene.AddDigit("TH", 9.0);
  scene.AddDigit("FF", 2.0);
  AddRodLink(scene.hand, 2, MakePose(Vector3d(0.0, 0.0, 0.1)), Vector3d::UnitY(), 0.02, 0.1);
  scene.hand.joints.back().drive = {1.0, 0.02, 0.6};
  Digit& finger = scene.hand.digits.back();
  finger.links.push_back(3);
  finger.distal_link = 3;
  scene.hand.contact_spheres.push_back({3, Vector3d(0.0, 0.0, 0.06), 0.005});
  scene.grasp.q_pre = Eigen::VectorXd::Zero(3);
  scene.grasp.q_target = Vector3d(0.3, 0.3, 0.3);
  EXPECT_NEAR(CalcGripBound(scene.hand, scene.grasp), 2.0 / 0.05 + 0.6 / 0.06, 1e-9);
  scene.grasp.q_target.z() = 0.0;  // the last link is carried along, on the longer lever
  EXPECT_NEAR(CalcGripBound(scene.hand, scene.grasp), 2.0 / 0.05, 1e-9);
}

}  // namespace
}  // namespace graspbench
