#include "core/develop/hand_pads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/hand/hand.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

// The TUM Hand's fingers stand along +z; index and middle face the thumb at +x, and the thumb them.
TEST(HandPadsTest, TumPadsFaceEachOtherWhenStraight) {
  const Hand hand = LoadHand("tum");
  const auto X_HL = CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()));
  for (const Digit& digit : hand.digits) {
    const PadState pad = CalcPadState(hand, digit, X_HL);
    EXPECT_LT((pad.axis_H - Vector3d::UnitZ()).norm(), 1e-9) << digit.id;
    EXPECT_LT((pad.nhat_H - Vector3d(digit.is_thumb ? -1 : 1, 0, 0)).norm(), 1e-9) << digit.id;
    EXPECT_LT((pad.p_HPad - X_HL[digit.distal_link] * digit.p_LPad).norm(), 1e-12);
  }
}

// Index and middle of the TUM Hand stand side by side along y: what looks from one to the other is a
// side, as far along the finger as the pad, on the outermost ball.
TEST(HandPadsTest, TumSidesLookAlongTheAxisOfFlexion) {
  const Hand hand = LoadHand("tum");
  const auto X_HL = CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()));
  for (const Digit& digit : hand.digits) {
    double radius = 0.0;
    for (const ContactSphere& ball : hand.contact_spheres) {
      if (ball.link == digit.distal_link) radius = std::max(radius, ball.radius);
    }
    const Vector3d p_HBase = X_HL[digit.distal_link].translation();
    const PadState pad = CalcPadState(hand, digit, X_HL);
    for (const double side : {-1.0, 1.0}) {
      const PadState state = CalcSideState(hand, digit, side, X_HL);
      EXPECT_NEAR(std::abs(state.nhat_H.y()), 1.0, 1e-9) << digit.id;
      const Vector3d expected(p_HBase.x(), p_HBase.y() + radius * state.nhat_H.y(), pad.p_HPad.z());
      EXPECT_LT((state.p_HPad - expected).norm(), 1e-9) << digit.id;
    }
    EXPECT_LT((CalcSideState(hand, digit, 1.0, X_HL).nhat_H +
               CalcSideState(hand, digit, -1.0, X_HL).nhat_H)
                  .norm(),
              1e-12);
  }
}

// A revolute joint moves a pad by axis x arm; the TUM Hand's outer joint follows the middle one, so
// its part comes on top.
TEST(HandPadsTest, JacobianIsAxisTimesArm) {
  const Hand hand = LoadHand("tum");
  Eigen::VectorXd q = Eigen::VectorXd::Zero(hand.num_joints());
  for (int j = 0; j < hand.num_joints(); ++j) {  // off the limits
    if (hand.joints[j].coupled_to < 0) q[j] = 0.1;
  }
  ApplyCoupling(hand, q);
  const auto X_HL = CalcLinkPoses(hand, q);
  for (const Digit& digit : hand.digits) {
    const std::vector<int> joints = FindGraspJoints(hand, {digit.id});
    ASSERT_EQ(joints.size(), 3u);
    const Eigen::MatrixXd J = CalcPadJacobian(hand, digit, q, joints);
    const Vector3d p_HPad = CalcPadState(hand, digit, X_HL).p_HPad;
    for (size_t k = 0; k < joints.size(); ++k) {
      Vector3d expected = Vector3d::Zero();
      for (int j = 0; j < hand.num_joints(); ++j) {
        if (j != joints[k] && hand.joints[j].coupled_to != joints[k]) continue;
        const auto link = static_cast<size_t>(hand.joints[j].link);
        const Vector3d axis_H = X_HL[link].linear() * hand.links[link].axis;
        expected += axis_H.cross(p_HPad - X_HL[link].translation());
      }
      EXPECT_LT((J.col(static_cast<Eigen::Index>(k)) - expected).norm(), 1e-8) << digit.id << k;
    }
  }
}

}  // namespace
}  // namespace graspbench
