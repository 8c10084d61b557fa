#include "core/physics/simbody/simbody_model.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/hand/hand.h"
#include "core/physics/hand_dynamics.h"
#include "core/physics/known_answers/small_scenes.h"
#include "tests/core/physics/random_vector.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/** A tree of `num_links` links with random frames, axes and inertia; branches are random too. */
Hand MakeRandomHand(int num_links, RandomStream& random) {
  Hand hand = MakeBareHand();
  HandLink& root = hand.links[0];
  root.mass = 1.3;
  root.p_LLcm = Vector3d(0.02, -0.01, 0.03);
  root.I_LLcm = Vector3d(1e-3, 2e-3, 2.5e-3).asDiagonal();
  root.X_PJ = MakePose(MakeRotationRpy(0.1, 0.7, -0.4), Vector3d(0.01, 0.04, -0.1));
  for (int i = 0; i < num_links; ++i) {
    const auto parent = random.NextIndex(static_cast<int>(hand.links.size()));
    const Pose X_PJ = MakePose(
        MakeRotationRpy(random.NextUniform(-3, 3), random.NextUniform(-1, 1),
                        random.NextUniform(-3, 3)),
        0.05 * Eigen::Vector3d(random.NextNormal(), random.NextNormal(), random.NextNormal()));
    const Eigen::Vector3d axis =
        Eigen::Vector3d(random.NextNormal(), random.NextNormal(), random.NextNormal()).normalized();
    AddRodLink(hand, parent, X_PJ, axis, random.NextUniform(0.01, 0.1),
               random.NextUniform(0.02, 0.06));
    hand.links.back().p_LLcm += 0.01 * Eigen::Vector3d(random.NextNormal(), random.NextNormal(), 0);
    hand.joints.back().is_prismatic = random.NextIndex(3) == 0;
  }
  return hand;
}

/** Poses, mass matrix and bias of a hand in a random state against Simbody's, whose joints all move
for themselves: with u_joint = T u, M = T' M_all T, and the bias likewise. */
void ExpectEqualsSimbody(const Hand& hand, const Eigen::MatrixXd& T, RandomStream& random) {
  const int joints = hand.num_joints();
  MassProperties object;
  object.mass = 0.1;
  object.I_OOcm = Vector3d(1e-4, 2e-4, 2.5e-4).asDiagonal();
  SimbodyModel simbody(hand, object);
  HandDynamics dynamics(hand);
  const int speeds = dynamics.num_speeds();
  ASSERT_EQ(speeds, T.cols());
  VectorXd q = MakeRandomVector(joints, 1.0, random);
  ApplyCoupling(hand, q);
  const VectorXd u = MakeRandomVector(speeds, 3.0, random);
  const Vector3d gravity = MakeRandomVector(3, 5.0, random);
  const Pose X_WH = MakePose(MakeRotationRpy(0.3, -0.8, 2.0), Vector3d(0.1, -0.2, 0.3));
  VectorXd all_speeds = VectorXd::Zero(joints + 12);
  all_speeds.head(joints + 6) = T * u;
  simbody.SetPositions(X_WH, q, Pose::Identity());
  simbody.SetSpeeds(all_speeds);
  dynamics.UpdatePositions(X_WH, q);
  std::vector<Pose> X_WL;
  simbody.CalcLinkPoses(X_WL);
  for (size_t i = 0; i < X_WL.size(); ++i) {
    EXPECT_LT((X_WL[i].matrix() - dynamics.X_WL(static_cast<int>(i)).matrix()).norm(), 1e-12);
  }
  Eigen::MatrixXd M(speeds, speeds);
  dynamics.CalcMassMatrix(M);
  const Eigen::MatrixXd M_all = simbody.CalcMassMatrix().topLeftCorner(joints + 6, joints + 6);
  EXPECT_LT((M - T.transpose() * M_all * T).cwiseAbs().maxCoeff(), 1e-11);
  VectorXd bias(speeds);
  dynamics.CalcBias(u, gravity, bias);
  const VectorXd bias_all = simbody.CalcBias(gravity).head(joints + 6);
  EXPECT_LT((bias - T.transpose() * bias_all).cwiseAbs().maxCoeff(), 1e-10);
}

// The oracle is Simbody itself: calcM and calcResidualForceIgnoringConstraints.
TEST(HandDynamics, EqualsSimbodyOnRandomTreesAndStates) {
  RandomStream random("dynamics", "test");
  for (int trial = 0; trial < 20; ++trial) {
    const Hand hand = MakeRandomHand(1 + random.NextIndex(24), random);
    const int speeds = hand.num_joints() + 6;
    ExpectEqualsSimbody(hand, Eigen::MatrixXd::Identity(speeds, speeds), random);
  }
}

// A linkage takes degrees of freedom away. Followers and what they follow lie on any branches.
TEST(HandDynamics, LinkagesAreSimbodysHandWithTiedSpeeds) {
  RandomStream random("linkages", "test");
  for (int trial = 0; trial < 20; ++trial) {
    Hand hand = MakeRandomHand(4 + random.NextIndex(8), random);
    const int joints = hand.num_joints(), dofs = (joints + 1) / 2;
    Eigen::MatrixXd T = Eigen::MatrixXd::Zero(joints + 6, dofs + 6);
    T.bottomRightCorner(6, 6).setIdentity();
    for (int j = 0; j < joints; ++j) {
      HandJoint& joint = hand.joints[static_cast<size_t>(j)];
      if (j % 2 == 1) {
        joint.coupled_to = 2 * random.NextIndex((joints + 1) / 2);
        joint.is_mimic = true;
        joint.mimic_ratio = random.NextUniform(-2.0, 2.0);
        joint.mimic_offset = random.NextUniform(-0.5, 0.5);
      }
      T(j, (joint.is_mimic ? joint.coupled_to : j) / 2) = joint.is_mimic ? joint.mimic_ratio : 1.0;
    }
    ExpectEqualsSimbody(hand, T, random);
  }
}

// A coupling that yields leaves the follower a speed of its own beside that of what it follows.
TEST(HandDynamics, YieldingLinkagesAreSimbodysHandWithAddedSpeeds) {
  RandomStream random("yielding", "test");
  for (int trial = 0; trial < 10; ++trial) {
    Hand hand = MakeRandomHand(6, random);
    HandJoint& follower = hand.joints[3];
    follower.coupled_to = 1;
    follower.is_mimic = true;
    follower.mimic_ratio = random.NextUniform(-2.0, 2.0);
    follower.coupling_compliance = 0.5;
    MassProperties object;
    object.mass = 0.1;
    object.I_OOcm = 1e-4 * Eigen::Matrix3d::Identity();
    SimbodyModel simbody(hand, object);
    HandDynamics dynamics(hand);
    ASSERT_EQ(dynamics.num_speeds(), 12);  // joints 0..5, of which 3 is the deviation, and base
    Eigen::MatrixXd T = Eigen::MatrixXd::Identity(12, 12);
    T(3, 1) = follower.mimic_ratio;
    const VectorXd q = MakeRandomVector(6, 1.0, random), u = MakeRandomVector(12, 3.0, random);
    const Vector3d gravity = MakeRandomVector(3, 5.0, random);
    VectorXd all_speeds = VectorXd::Zero(18);
    all_speeds.head(12) = T * u;
    simbody.SetPositions(Pose::Identity(), q, Pose::Identity());
    simbody.SetSpeeds(all_speeds);
    dynamics.UpdatePositions(Pose::Identity(), q);
    Eigen::MatrixXd M(12, 12);
    dynamics.CalcMassMatrix(M);
    const Eigen::MatrixXd M_all = simbody.CalcMassMatrix().topLeftCorner(12, 12);
    EXPECT_LT((M - T.transpose() * M_all * T).cwiseAbs().maxCoeff(), 1e-11);
    VectorXd bias(12);
    dynamics.CalcBias(u, gravity, bias);
    EXPECT_LT((bias - T.transpose() * simbody.CalcBias(gravity).head(12)).cwiseAbs().maxCoeff(),
              1e-10);
  }
}

TEST(SimbodyModel, HoldsTheObjectAboutItsCentreOfMass) {
  MassProperties object;
  object.mass = 0.2;
  object.I_OOcm << 1e-4, 1e-5, 0, 1e-5, 2e-4, 0, 0, 0, 2.5e-4;
  SimbodyModel simbody(MakeBareHand(), object);
  const Pose X_WO = MakePose(MakeRotationRpy(0.4, 0.5, 0.6), Vector3d(1, 2, 3));
  const Vector3d w(1.0, -2.0, 3.0);
  VectorXd u(12);
  u << VectorXd::Zero(6), w, 0.1, 0.2, 0.3;
  simbody.SetPositions(Pose::Identity(), VectorXd(), X_WO);
  simbody.SetSpeeds(u);
  const Eigen::Matrix3d I_W = X_WO.linear() * object.I_OOcm * X_WO.linear().transpose();
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(6, 6);
  M.topLeftCorner<3, 3>() = I_W;
  M.bottomRightCorner<3, 3>() = 0.2 * Eigen::Matrix3d::Identity();
  EXPECT_LT((simbody.CalcMassMatrix().bottomRightCorner(6, 6) - M).cwiseAbs().maxCoeff(), 1e-15);
  VectorXd bias(6);
  bias << w.cross(I_W * w), 0.0, 0.0, 0.2 * kStandardGravity;  // Euler's equations
  const Vector3d gravity_W(0, 0, -kStandardGravity);
  EXPECT_LT((simbody.CalcBias(gravity_W).tail(6) - bias).cwiseAbs().maxCoeff(), 1e-14);
}

}  // namespace
}  // namespace graspbench
