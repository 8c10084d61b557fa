#include "core/trial/grip/grip_limit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/physics/known_answers/small_scenes.h"

namespace graspbench {
namespace {

struct Scene {
  Hand hand = MakeBareHand();
  Grasp grasp;

  /** A rod of 0.1 m with balls of 5 mm at its middle and its end. */
  void AddDigit(const std::string& id, double torque_limit) {
    AddRodLink(hand, 0, Pose::Identity(), Eigen::Vector3d::UnitY(), 0.02, 0.1);
    hand.joints.back().drive = {1.0, 0.02, torque_limit};
    Digit digit;
    digit.id = id;
    digit.is_thumb = id == "TH";
    digit.links = {static_cast<int>(hand.links.size()) - 1};
    digit.distal_link = digit.links.front();
    digit.p_LPad = Eigen::Vector3d(0.0, 0.0, 0.1);
    for (const double z : {0.05, 0.1}) {
      hand.contact_spheres.push_back({digit.distal_link, Eigen::Vector3d(0.0, 0.0, z), 0.005});
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
  AddRodLink(scene.hand, 2, MakePose(Eigen::Vector3d(0.0, 0.0, 0.1)), Eigen::Vector3d::UnitY(),
             0.02, 0.1);
  scene.hand.joints.back().drive = {1.0, 0.02, 0.6};
  Digit& finger = scene.hand.digits.back();
  finger.links.push_back(3);
  finger.distal_link = 3;
  scene.hand.contact_spheres.push_back({3, Eigen::Vector3d(0.0, 0.0, 0.06), 0.005});
  scene.grasp.q_pre = Eigen::VectorXd::Zero(3);
  scene.grasp.q_target = Eigen::Vector3d(0.3, 0.3, 0.3);
  EXPECT_NEAR(CalcGripBound(scene.hand, scene.grasp), 2.0 / 0.05 + 0.6 / 0.06, 1e-9);
  scene.grasp.q_target.z() = 0.0;  // the last link is carried along, on the longer lever
  EXPECT_NEAR(CalcGripBound(scene.hand, scene.grasp), 2.0 / 0.05, 1e-9);
}

}  // namespace
}  // namespace graspbench
