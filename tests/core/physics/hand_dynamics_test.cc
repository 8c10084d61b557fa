#include "core/physics/hand_dynamics.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "core/physics/known_answers/small_scenes.h"
#include "tests/core/physics/random_vector.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

// Simbody is the oracle in simbody_model_test.cc; here are differences of positions alone.

class EveryHandDynamics : public testing::TestWithParam<const char*> {};

// The motion vectors against central differences of a point of every link.
TEST_P(EveryHandDynamics, MotionVectorsAreTheDerivativesOfPoints) {
  const Hand hand = LoadHand(GetParam());
  HandDynamics dynamics(hand);
  RandomStream random("hand dynamics", "test");
  const Pose X_WH = MakePose(MakeRotationRpy(0.4, -0.3, 1.1), Vector3d(0.1, 0.2, 0.3));
  const VectorXd q = MakeRandomVector(hand.num_joints(), 0.6, random);
  const Vector3d p_LP(0.01, -0.02, 0.03);
  const auto find_points = [&](const VectorXd& angles) {
    dynamics.UpdatePositions(X_WH, angles);
    std::vector<Vector3d> points;
    for (size_t link = 0; link < hand.links.size(); ++link) {
      points.push_back(dynamics.X_WL(static_cast<int>(link)) * p_LP);
    }
    return points;
  };
  constexpr double kDelta = 1e-6;
  for (int joint = 0; joint < hand.num_joints(); ++joint) {
    VectorXd more = q, less = q;
    more[joint] += kDelta;
    less[joint] -= kDelta;
    const std::vector<Vector3d> up = find_points(more), down = find_points(less);
    const std::vector<Vector3d> at = find_points(q);
    for (size_t link = 0; link < hand.links.size(); ++link) {
      const std::vector<int>& chain = dynamics.chain(static_cast<int>(link));
      const bool moves = std::find(chain.begin(), chain.end(), joint) != chain.end();
      const SpatialVector& S = dynamics.motion(joint);
      const Vector3d expected = Vector3d(S.tail<3>()) + Vector3d(S.head<3>()).cross(at[link]);
      const Vector3d obtained = (up[link] - down[link]) / (2.0 * kDelta);
      EXPECT_LT((obtained - (moves ? expected : Vector3d(Vector3d::Zero()))).norm(), 1e-9)
          << hand.joints[joint].name << " on " << hand.links[link].name;
    }
  }
}

// u' M u / 2 is the kinetic energy of all links, taken from differences of their poses.
TEST_P(EveryHandDynamics, MassMatrixGivesTheKineticEnergy) {
  Hand hand = LoadHand(GetParam());
  for (HandJoint& joint : hand.joints) joint.coupled_to = -1;
  HandDynamics dynamics(hand);
  RandomStream random("kinetic energy", "test");
  const VectorXd q = MakeRandomVector(hand.num_joints(), 0.6, random);
  const int joints = hand.num_joints();
  const VectorXd u = MakeRandomVector(joints + 6, 2.0, random);
  const auto find_poses = [&](double t) {
    Pose X_WH = MakePose(t * u.tail<3>());
    const Vector3d turned = t * u.segment<3>(joints);
    if (t != 0.0) X_WH.rotate(Eigen::AngleAxisd(turned.norm(), turned.normalized()));
    dynamics.UpdatePositions(X_WH, q + t * u.head(joints));
    std::vector<Pose> poses;
    for (size_t i = 0; i < hand.links.size(); ++i) {
      poses.push_back(dynamics.X_WL(static_cast<int>(i)));
    }
    return poses;
  };
  constexpr double kDelta = 1e-5;
  const std::vector<Pose> after = find_poses(kDelta), before = find_poses(-kDelta);
  double expected = 0.0;
  for (size_t i = 0; i < hand.links.size(); ++i) {
    const HandLink& link = hand.links[i];
    const Vector3d v = (after[i] * link.p_LLcm - before[i] * link.p_LLcm) / (2.0 * kDelta);
    const Eigen::AngleAxisd turn(
        Eigen::Matrix3d(before[i].linear().transpose() * after[i].linear()));
    const Vector3d w_L = turn.angle() / (2.0 * kDelta) * turn.axis();
    expected += 0.5 * link.mass * v.squaredNorm() + 0.5 * w_L.dot(link.I_LLcm * w_L);
  }
  find_poses(0.0);
  Eigen::MatrixXd M(dynamics.num_speeds(), dynamics.num_speeds());
  dynamics.CalcMassMatrix(M);
  EXPECT_NEAR(0.5 * u.dot(M * u), expected, 1e-7 * expected);
}

INSTANTIATE_TEST_SUITE_P(Hands, EveryHandDynamics, testing::Values("tum", "shadow"));

// A rod of mass m and length l on a pin: M = m l^2 / 3, and gravity's moment is m g l/2 sin(a).
TEST(HandDynamics, RodOnAPinHasItsClosedForm) {
  constexpr double kMass = 0.2, kLength = 0.3;
  Hand hand = MakeBareHand();
  AddRodLink(hand, 0, Pose::Identity(), Vector3d::UnitX(), kMass, kLength);
  HandDynamics dynamics(hand);
  const double angle = 0.7;
  dynamics.UpdatePositions(Pose::Identity(), VectorXd::Constant(1, angle));
  Eigen::MatrixXd M(7, 7);
  dynamics.CalcMassMatrix(M);
  EXPECT_NEAR(M(0, 0), kMass * kLength * kLength / 3.0, 2e-7);  // the rod is 1e-7 kg m^2 thick
  VectorXd bias(7);
  dynamics.CalcBias(2.0 * VectorXd::Unit(7, 0), Vector3d(0.0, 0.0, -kStandardGravity), bias);
  // The rod stands along z at zero and leans by `angle`: gravity pulls it further over.
  const double moment = kMass * kStandardGravity * 0.5 * kLength * std::sin(angle);
  EXPECT_NEAR(bias[0], -moment, 1e-12);
}

}  // namespace
}  // namespace graspbench
