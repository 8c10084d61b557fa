#include "core/quality/wrench_hull.h"

#include <gtest/gtest.h>

#include "core/quality/epsilon_fast.h"
#include "tests/core/quality/grasp_samples.h"

namespace graspbench {
namespace {

// Known answers: closed forms for generators f = n + mu t (unit normal force), moments divided by
// rho about the centre. The hull and the fast method must both give them.
void ExpectKnown(const Eigen::MatrixXd& wrenches, double epsilon, double volume, double tolerance) {
  const WrenchHull hull = CalcWrenchHull(wrenches);
  EXPECT_NEAR(CalcEpsilon(hull), epsilon, tolerance);
  EXPECT_NEAR(hull.volume, volume, tolerance);
  const EpsilonBounds bounds = CalcEpsilonBounds(wrenches);
  EXPECT_NEAR(bounds.lower, epsilon, tolerance);
  EXPECT_NEAR(bounds.upper, epsilon, tolerance);
}

constexpr double kClosedForm = 1e-9;
constexpr double kSixDigits = 6e-7;  // of the published volumes

TEST(KnownAnswers, Q1ThreeContactsOnADisc) {
  const std::vector<double> angles_deg{90.0, 210.0, 330.0};
  ExpectKnown(MakeDiscWrenches(angles_deg, 0.3), 0.3, 1.072806, kSixDigits);
  ExpectKnown(MakeDiscWrenches(angles_deg, 0.5), 0.5, 2.157291, kSixDigits);
  ExpectKnown(MakeDiscWrenches(angles_deg, 1.0), 0.93511, 6.464102, 6e-6);
  for (const double mu : {0.05, 0.4, 0.9, 0.912}) {
    const Eigen::MatrixXd wrenches = MakeDiscWrenches(angles_deg, mu);
    EXPECT_NEAR(CalcEpsilon(CalcWrenchHull(wrenches)), mu, kClosedForm);
    EXPECT_NEAR(CalcEpsilonBounds(wrenches).upper, mu, kClosedForm);
  }
  EXPECT_LT(CalcEpsilon(CalcWrenchHull(MakeDiscWrenches(angles_deg, 0.9125))), 0.9125 - 1e-5);
}

TEST(KnownAnswers, Q2TwoContactsOnADisc) {
  for (const double mu : {0.1, 0.5, 1.0, 2.0}) {
    ExpectKnown(MakeDiscWrenches({0.0, 180.0}, mu), mu / std::sqrt(mu * mu + 2.0),
                8.0 * mu * mu / 3.0, kClosedForm);
  }
}

Eigen::MatrixXd MakeCubeWrenches(double a, double mu, int num_edges) {
  WrenchSpace space;
  space.num_edges = num_edges;
  space.torque_scale = a;
  return CalcConeWrenches(MakeCubeGrasp(a, mu), space).wrenches;
}

TEST(KnownAnswers, Q3CubeWithFourEdges) {
  for (const double mu : {0.1, 0.5, 1.0}) {
    const Eigen::MatrixXd wrenches = MakeCubeWrenches(0.03, mu, 4);
    EXPECT_NEAR(CalcEpsilon(CalcWrenchHull(wrenches)), mu / std::sqrt(3.0), kClosedForm);
    EXPECT_NEAR(CalcEpsilonBounds(wrenches).upper, mu / std::sqrt(3.0), kClosedForm);
  }
  ExpectKnown(MakeCubeWrenches(0.03, 0.5, 4), 0.5 / std::sqrt(3.0), 0.3125, kClosedForm);
}

TEST(KnownAnswers, Q4CubeWithMoreEdges) {
  const double epsilon = 0.5 * std::sqrt(2.0 / 3.0);
  ExpectKnown(MakeCubeWrenches(0.03, 0.5, 8), epsilon, 0.598634, kSixDigits);
  ExpectKnown(MakeCubeWrenches(0.03, 0.5, 16), epsilon, 0.670086, kSixDigits);
  ExpectKnown(MakeCubeWrenches(0.03, 0.5, 32), epsilon, 0.690734, kSixDigits);
  for (const int num_edges : {8, 16, 32}) {
    EXPECT_NEAR(CalcEpsilonBounds(MakeCubeWrenches(0.03, 0.5, num_edges)).upper, epsilon,
                kClosedForm);
  }
}

TEST(KnownAnswers, Q9TwoHardFingersAreNeverClosed) {
  for (const double mu : {0.1, 0.5, 1.0, 3.0, 100.0}) {
    const Eigen::MatrixXd wrenches = CalcConeWrenches(MakePinch(1.0, mu, 0.0), {}).wrenches;
    const WrenchHull hull = CalcWrenchHull(wrenches);
    EXPECT_TRUE(hull.is_flat);
    EXPECT_EQ(CalcEpsilon(hull), 0.0);
    EXPECT_EQ(hull.volume, 0.0);
    EXPECT_EQ(CalcEpsilonBounds(wrenches).upper, 0.0);
  }
}

TEST(KnownAnswers, Q11CubeWithoutFriction) {
  const Eigen::MatrixXd wrenches = MakeCubeWrenches(0.03, 0.0, 8);
  EXPECT_EQ(wrenches.cols(), 6);
  EXPECT_EQ(CalcEpsilon(CalcWrenchHull(wrenches)), 0.0);
  EXPECT_EQ(CalcWrenchHull(wrenches).volume, 0.0);
  EXPECT_EQ(CalcEpsilonBounds(wrenches).upper, 0.0);
}

// The cross polytope: volume 2^d / d!, epsilon 1 / sqrt(d).
TEST(WrenchHull, CrossPolytope) {
  Eigen::MatrixXd points(6, 12);
  points << Eigen::MatrixXd::Identity(6, 6), -Eigen::MatrixXd::Identity(6, 6);
  ExpectKnown(points, 1.0 / std::sqrt(6.0), 64.0 / 720.0, 1e-14);
  const WrenchHull hull = CalcWrenchHull(points);
  EXPECT_EQ(hull.offsets.size(), 64);
  EXPECT_EQ(hull.joggle, 0.0);
  EXPECT_LT(hull.centre.norm(), 1e-15);
}

// A box away from the origin has its volume, its centre, and no ball around the origin.
TEST(WrenchHull, BoxBesideTheOrigin) {
  Eigen::MatrixXd points(6, 64);
  for (int i = 0; i < 64; ++i) {
    for (int k = 0; k < 6; ++k) points(k, i) = ((i >> k) & 1) * (k + 1.0);
  }
  points.row(0).array() += 0.5;
  const WrenchHull hull = CalcWrenchHull(points);
  EXPECT_NEAR(hull.volume, 720.0, 1e-9);
  for (int k = 1; k < 6; ++k) EXPECT_NEAR(hull.centre[k], (k + 1.0) / 2.0, 1e-12);
  EXPECT_NEAR(hull.centre[0], 1.0, 1e-12);
  EXPECT_EQ(CalcEpsilon(hull), 0.0);
  EXPECT_EQ(CalcEpsilonBounds(points).upper, 0.0);
}

// Every point of the set lies inside every facet, and every facet touches the set.
TEST(WrenchHull, FacetsHoldAllPoints) {
  RandomStream stream("wrench hull", "facets");
  for (int i = 0; i < 8; ++i) {
    const Eigen::MatrixXd wrenches = CalcConeWrenches(MakeRandomGrasp(stream, 4), {}).wrenches;
    const WrenchHull hull = CalcWrenchHull(wrenches);
    if (hull.is_flat) continue;
    const Eigen::VectorXd slack =
        hull.offsets - (hull.normals.transpose() * wrenches).rowwise().maxCoeff();
    EXPECT_LT(slack.cwiseAbs().maxCoeff(), 1e-9);
  }
}

// Ten contacts on a cube's faces, one of two thousand such grasps that defeat Qhull's merging of
// coplanar facets: the joggled hull still is the hull.
TEST(WrenchHull, DegenerateGraspIsHulled) {
  RandomStream stream("wrench hull", "885");
  std::vector<GraspContact> contacts(4 + stream.NextIndex(8));
  for (GraspContact& contact : contacts) {
    const int axis = stream.NextIndex(3);
    contact.nhat_O = (stream.NextIndex(2) == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(axis);
    for (int k = 2; k >= 0; --k) contact.p_OC[k] = stream.NextUniform(-1.0, 1.0);
    contact.p_OC[axis] = -contact.nhat_O[axis];
    contact.mu = 1.0;
  }
  WrenchSpace space;
  space.torque_scale = std::sqrt(3.0);
  const Eigen::MatrixXd wrenches = CalcConeWrenches(contacts, space).wrenches;
  const WrenchHull hull = CalcWrenchHull(wrenches);
  EXPECT_LT(hull.joggle, 1e-9);
  EXPECT_NEAR(CalcEpsilon(hull), CalcEpsilonBounds(wrenches).upper, 1e-9);
}

}  // namespace
}  // namespace graspbench
