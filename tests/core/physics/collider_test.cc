#include "core/physics/collider.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/hand/contact_shape.h"
#include "core/physics/known_answers/small_scenes.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/** Two fingers of two links, each with a ball at its end, beside each other. */
Hand MakeTwoFingers() {
  Hand hand = MakeBareHand();
  for (const double side : {-0.02, 0.02}) {
    const int parent = static_cast<int>(hand.links.size());
    AddRodLink(hand, 0, MakePose(Vector3d(side, 0.0, 0.0)), Vector3d::UnitX(), 0.02, 0.05);
    AddRodLink(hand, parent, MakePose(Vector3d(0.0, 0.0, 0.05)), Vector3d::UnitY(), 0.02, 0.04);
    const int tip = parent + 1;
    hand.links[tip].surface.torsion_radius = 0.004;
    hand.contact_spheres.push_back({tip, Vector3d(0.0, 0.0, 0.04), 0.008});
    hand.capsules.push_back({tip, Vector3d::Zero(), Vector3d(0.0, 0.0, 0.04), 0.008});
    Digit digit;
    digit.id = side < 0.0 ? "TH" : "FF";
    digit.links = {parent, tip};
    digit.distal_link = tip;
    hand.digits.push_back(digit);
  }
  return hand;
}

struct Scene {
  Hand hand = MakeTwoFingers();
  GraspObject object = MakeSolid(MakeSphere(0.03, 64), 0.1, 0.6, 0.5);
  SimConfig config;
  HandDynamics dynamics{hand};
  Collider collider{hand, object, config, TablePresence::kPresent};
  std::vector<ContactPoint> contacts;

  void Find(const VectorXd& q, const Pose& X_WH, const Vector3d& p_WO) {
    dynamics.UpdatePositions(X_WH, q);
    collider.FindContacts(dynamics, MakePose(p_WO), p_WO, 0, contacts);
  }
};

TEST(Collider, BallOnBallHasTheDepthOfItsGeometry) {
  Scene scene;
  // Fingers hang down; the object's ball meets the first finger's ball from below, 0.1 mm deep.
  const Pose X_WH = MakePose(MakeRotationRpy(kPi, 0.0, 0.0), Vector3d(0.0, 0.0, 1.0));
  const Vector3d p_WTip = X_WH * Vector3d(-0.02, 0.0, 0.09);
  const Vector3d direction = Vector3d(-0.3, 0.1, -1.0).normalized();
  scene.Find(VectorXd::Zero(4), X_WH, p_WTip + (0.038 - 1e-4) * direction);
  ASSERT_EQ(scene.contacts.size(), 1u);
  const ContactPoint& contact = scene.contacts[0];
  EXPECT_EQ(contact.link, 2);
  EXPECT_TRUE(contact.is_on_object);
  EXPECT_NEAR(contact.depth, 1e-4, 4e-5);  // the mesh's facets lie up to 36 um inside the ball
  EXPECT_LT((contact.nhat_BA_W + direction).norm(), 0.02);
  EXPECT_LT((contact.p_WC - (p_WTip + 0.008 * direction)).norm(), 2e-4);
  EXPECT_EQ(contact.material.friction_static, 0.6);
  EXPECT_EQ(contact.material.torsion_radius, 0.004);
}

// The rows against central differences: moving one freedom by a little moves the points of both
// bodies, and the rates are those of their difference along normal, tangents and spin.
TEST(Collider, JacobiansAreTheDerivativesOfTheContactsPoints) {
  Scene scene;
  const Pose X_WH = MakePose(MakeRotationRpy(2.9, 0.2, 0.4), Vector3d(0.0, 0.0, 1.0));
  VectorXd q(4);
  q << 0.2, -0.3, 0.1, 0.4;
  scene.dynamics.UpdatePositions(X_WH, q);
  const Vector3d p_WTip = scene.dynamics.X_WL(2) * Vector3d(0.0, 0.0, 0.04);
  const Vector3d p_WO = p_WTip + 0.0379 * Vector3d(0.4, -0.5, -0.7).normalized();
  scene.Find(q, X_WH, p_WO);
  ASSERT_FALSE(scene.contacts.empty());
  const ContactPoint contact = scene.contacts[0];
  ASSERT_EQ(contact.num_rows(), 4);
  const Vector3d p_LC = scene.dynamics.X_WL(contact.link).inverse() * contact.p_WC;
  constexpr double kDelta = 1e-6;
  const Vector3d rows[3] = {contact.nhat_BA_W, contact.tangent1_W, contact.tangent2_W};
  std::vector<bool> seen(16, false);
  for (int i = 0; i < contact.num_dofs; ++i) {
    const int dof = contact.dofs[i];
    seen[dof] = true;
    Vector3d v, w;  // of A's point minus B's, by a unit rate of the freedom
    if (dof < 4) {
      VectorXd more = q, less = q;
      more[dof] += kDelta;
      less[dof] -= kDelta;
      scene.dynamics.UpdatePositions(X_WH, more);
      const Pose X_up = scene.dynamics.X_WL(contact.link);
      scene.dynamics.UpdatePositions(X_WH, less);
      const Pose X_down = scene.dynamics.X_WL(contact.link);
      v = (X_up * p_LC - X_down * p_LC) / (2.0 * kDelta);
      const Eigen::AngleAxisd turn(Eigen::Matrix3d(X_up.linear() * X_down.linear().transpose()));
      w = turn.angle() / (2.0 * kDelta) * turn.axis();
    } else {
      const bool is_base = dof < 10, turns = (dof - 4) % 6 < 3;
      const Vector3d axis = (is_base ? 1.0 : -1.0) * Vector3d::Unit((dof - 4) % 3);
      w = turns ? axis : Vector3d(Vector3d::Zero());
      v = turns ? Vector3d(w.cross(contact.p_WC - (is_base ? X_WH.translation() : p_WO))) : axis;
    }
    for (int row = 0; row < 3; ++row) {
      EXPECT_NEAR(contact.jacobian[row][i], rows[row].dot(v), 1e-8) << row << ' ' << dof;
    }
    EXPECT_NEAR(contact.jacobian[kSpinRow][i], contact.nhat_BA_W.dot(w), 1e-8) << dof;
  }
  EXPECT_EQ(seen, (std::vector<bool>{true, true, false, false, true, true, true, true, true, true,
                                     true, true, true, true, true, true}));
}

// Distance of two segments by trying many pairs of points.
double FindDistanceByForce(const Vector3d& a0, const Vector3d& a1, const Vector3d& b0,
                           const Vector3d& b1) {
  double least = 1e9;
  for (int i = 0; i <= 400; ++i) {
    for (int j = 0; j <= 400; ++j) {
      least = std::min(least, (a0 + (a1 - a0) * (i / 400.0) - b0 - (b1 - b0) * (j / 400.0)).norm());
    }
  }
  return least;
}

// Links against each other, over random postures: contacts are exactly the pairs nearer than the
// margin, at the distance found by trying all points.
TEST(Collider, SelfContactsHaveTheDistanceOfTheCapsules) {
  Scene scene;
  RandomStream random("collider", "test");
  const Pose X_WH = MakePose(Vector3d(0.0, 0.0, 1.0));
  int num_near = 0;
  for (int trial = 0; trial < 40; ++trial) {
    VectorXd q(4);
    q << random.NextUniform(-0.3, 0.3), random.NextUniform(0.2, 1.0), random.NextUniform(-0.3, 0.3),
        -random.NextUniform(0.2, 1.0);
    scene.Find(q, X_WH, Vector3d(3.0, 0.0, 3.0));
    const auto end = [&](int link, double z) -> Vector3d {
      return scene.dynamics.X_WL(link) * Vector3d(0.0, 0.0, z);
    };
    const double gap =
        FindDistanceByForce(end(2, 0.0), end(2, 0.04), end(4, 0.0), end(4, 0.04)) - 0.016;
    if (std::abs(gap - Collider::kMargin) < 1e-4) continue;
    ASSERT_EQ(scene.contacts.size(), gap < Collider::kMargin ? 1u : 0u) << gap;
    if (scene.contacts.empty()) continue;
    ++num_near;
    EXPECT_NEAR(scene.contacts[0].depth, -gap, 5e-5);  // the grid of points is 0.1 mm wide
    EXPECT_FALSE(scene.contacts[0].is_on_object);
  }
  EXPECT_GT(num_near, 5);
}

Vector3d DrawDirection(RandomStream& random) {
  return Vector3d(random.NextNormal(), random.NextNormal(), random.NextNormal()).normalized();
}

// What a collider remembers of balls that were apart spares questions and changes no answer: on a
// way of small and large steps it finds what one finds that has seen nothing, and all capsules that
// meet.
TEST(Collider, FindsOnAWayWhatItFindsAtOnce) {
  Scene scene;
  RandomStream random("collider way", "test");
  for (const int tip : {2, 4}) {
    for (int k = 0; k < 12; ++k) {
      const Vector3d p_LA = 0.012 * DrawDirection(random) + Vector3d(0.0, 0.0, 0.03);
      scene.hand.contact_spheres.push_back({tip, p_LA, 0.003});
      scene.hand.capsules.push_back({tip, p_LA, p_LA + 0.01 * DrawDirection(random), 0.002});
    }
  }
  const GraspObject block = MakeBlock(0.1);
  const std::vector<CapsulePair> pairs = FindCapsulePairs(scene.hand);
  const Pose X_WH = MakePose(MakeRotationRpy(kPi, 0.0, 0.0), Vector3d(0.0, 0.0, 0.6));
  Collider seasoned(scene.hand, block, scene.config, TablePresence::kPresent);
  VectorXd q = VectorXd::Zero(4);
  int num_on_object = 0, num_on_itself = 0;
  for (int step = 0; step < 1000; ++step) {
    const double turn = step % 50 == 0 ? 0.2 : 0.006;
    for (double& angle : q) angle = std::clamp(angle + turn * random.NextNormal(), -1.0, 1.0);
    // To the fingers, between them and away again, a millimetre a step.
    const Vector3d p_WO(0.03 * std::sin(0.031 * step), 0.01 * std::sin(0.017 * step),
                        0.49 + 0.03 * std::sin(0.037 * step));
    const Pose X_WO = MakePose(MakeRotationRpy(0.01 * step, 0.1, 0.2), p_WO);
    scene.dynamics.UpdatePositions(X_WH, q);
    std::vector<ContactPoint> along, at_once;
    seasoned.FindContacts(scene.dynamics, X_WO, p_WO, step, along);
    Collider(scene.hand, block, scene.config, TablePresence::kPresent)
        .FindContacts(scene.dynamics, X_WO, p_WO, step, at_once);
    ASSERT_EQ(along.size(), at_once.size()) << step;
    int left = 0;
    for (size_t k = 0; k < along.size(); ++k) {
      ASSERT_EQ(along[k].p_WC, at_once[k].p_WC) << step;
      ASSERT_EQ(along[k].depth, at_once[k].depth) << step;
      ASSERT_EQ(along[k].link, at_once[k].link) << step;
      ++(along[k].is_on_object ? num_on_object : left);
    }
    num_on_itself += left;
    const std::vector<Pose> X_HL = CalcLinkPoses(scene.hand, q);
    for (const CapsulePair& pair : pairs) {
      const double gap = CalcCapsuleGap(scene.hand, pair, X_HL);
      if (std::abs(gap - Collider::kMargin) > 1e-9) left -= gap < Collider::kMargin;
    }
    ASSERT_EQ(left, 0) << step;
  }
  EXPECT_GT(num_on_object, 100);
  EXPECT_GT(num_on_itself, 30);
}

TEST(Collider, GapsAndLowestPointAreThoseOfTheScene) {
  Scene scene;
  const Pose X_WH = MakePose(MakeRotationRpy(kPi, 0.0, 0.0), Vector3d(0.0, 0.0, 0.2));
  scene.dynamics.UpdatePositions(X_WH, VectorXd::Zero(4));
  // Tips at z = 0.11; the ball below the first one, then far away.
  const Vector3d p_WTip = X_WH * Vector3d(-0.02, 0.0, 0.09);
  const Pose below = MakePose(p_WTip - Vector3d(0.0, 0.0, 0.008 + 0.03 + 0.005));
  EXPECT_NEAR(scene.collider.CalcSmallestGap(scene.dynamics, below), 0.005, 4e-5);
  EXPECT_NEAR(scene.collider.CalcLowestPoint(below), below.translation().z() - 0.03, 1e-6);
  const Pose away = MakePose(Vector3d(1.0, 0.0, 0.1));
  EXPECT_NEAR(scene.collider.CalcSmallestGap(scene.dynamics, away), 0.11 - 0.008, 1e-9);
}

}  // namespace
}  // namespace graspbench
