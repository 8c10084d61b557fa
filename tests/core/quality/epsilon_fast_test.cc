#include "core/quality/epsilon_fast.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/quality/grasp_quality.h"
#include "core/quality/wrench_hull.h"
#include "tests/core/quality/grasp_samples.h"

namespace graspbench {
namespace {

double CalcEpsilonOf(const std::vector<GraspContact>& contacts, const WrenchSpace& space = {}) {
  const EpsilonBounds bounds = CalcEpsilonBounds(CalcConeWrenches(contacts, space).wrenches);
  EXPECT_LE(bounds.upper - bounds.lower, 1e-9);
  return bounds.upper;
}

// The support function at the weakest direction is epsilon, and no random direction goes below: a
// check that shares no code with the polytope.
TEST(EpsilonFast, NoDirectionIsWeakerThanTheWeakest) {
  RandomStream stream("epsilon fast", "directions");
  for (int i = 0; i < 50; ++i) {
    const Eigen::MatrixXd wrenches =
        CalcConeWrenches(MakeRandomGrasp(stream, 3 + stream.NextIndex(8)), {}).wrenches;
    const EpsilonBounds bounds = CalcEpsilonBounds(wrenches);
    if (bounds.upper == 0.0) continue;
    EXPECT_NEAR((bounds.weakest_direction.transpose() * wrenches).maxCoeff(), bounds.upper, 1e-12);
    for (int k = 0; k < 2000; ++k) {
      // Half of the directions lie around the weakest one, where a better one would hide.
      Eigen::VectorXd direction(6);
      for (double& value : direction) value = stream.NextNormal();
      if (k % 2 == 0) direction = bounds.weakest_direction + 0.02 * direction;
      direction.normalize();
      ASSERT_GE((direction.transpose() * wrenches).maxCoeff(), bounds.lower - 1e-12);
    }
  }
}

TEST(EpsilonFast, AgreesWithTheHull) {
  RandomStream stream("epsilon fast", "hull");
  int num_closed = 0;
  for (int i = 0; i < 100; ++i) {
    const Eigen::MatrixXd wrenches =
        CalcConeWrenches(MakeRandomGrasp(stream, 2 + stream.NextIndex(6)), {}).wrenches;
    const double epsilon = CalcEpsilon(CalcWrenchHull(wrenches));
    const EpsilonBounds bounds = CalcEpsilonBounds(wrenches);
    ASSERT_NEAR(bounds.lower, epsilon, 1e-9) << "grasp " << i;
    ASSERT_NEAR(bounds.upper, epsilon, 1e-9) << "grasp " << i;
    num_closed += epsilon > 0.0;
  }
  EXPECT_GT(num_closed, 30);
  EXPECT_LT(num_closed, 95);
}

// Integer grids: every plane holds many points, ridges are collinear, points repeat.
TEST(EpsilonFast, AgreesWithTheHullOnGrids) {
  RandomStream stream("epsilon fast", "grid");
  for (int i = 0; i < 200; ++i) {
    Eigen::MatrixXd points(i % 2 == 0 ? 3 : 6, 12 + stream.NextIndex(40));
    for (double& value : points.reshaped()) value = stream.NextIndex(3) - 1.0;
    const EpsilonBounds bounds = CalcEpsilonBounds(points);
    const double epsilon = CalcEpsilon(CalcWrenchHull(points));
    ASSERT_NEAR(bounds.lower, epsilon, 1e-9) << "set " << i;
    ASSERT_NEAR(bounds.upper, epsilon, 1e-9) << "set " << i;
  }
}

TEST(EpsilonFast, NoPointsNoBall) {
  EXPECT_EQ(CalcEpsilonBounds(Eigen::MatrixXd(6, 0)).upper, 0.0);
  EXPECT_EQ(CalcEpsilonBounds(Eigen::MatrixXd::Zero(6, 20)).upper, 0.0);
}

TEST(EpsilonRelations, InvariantUnderMotionOrderAndDuplicates) {
  RandomStream stream("epsilon fast", "motion");
  for (int i = 0; i < 30; ++i) {
    std::vector<GraspContact> contacts = MakeRandomGrasp(stream, 5);
    for (GraspContact& contact : contacts) contact.first_edge_O = MakeRandomDirection(stream);
    const double epsilon = CalcEpsilonOf(contacts);

    const Eigen::Matrix3d R = MakeRandomRotation(stream);
    WrenchSpace moved;
    moved.p_OR = 5.0 * MakeRandomDirection(stream);
    EXPECT_NEAR(CalcEpsilonOf(Move(contacts, R, moved.p_OR), moved), epsilon, 1e-9);

    std::reverse(contacts.begin(), contacts.end());
    EXPECT_NEAR(CalcEpsilonOf(contacts), epsilon, 1e-9);
    contacts.push_back(contacts[1]);
    EXPECT_NEAR(CalcEpsilonOf(contacts), epsilon, 1e-9);
  }
}

TEST(EpsilonRelations, InvariantUnderScalingWithTheTorqueScale) {
  RandomStream stream("epsilon fast", "scaling");
  for (int i = 0; i < 30; ++i) {
    std::vector<GraspContact> contacts = MakeRandomGrasp(stream, 5);
    const double epsilon = CalcEpsilonOf(contacts);
    WrenchSpace small;
    small.torque_scale = 0.037;
    for (GraspContact& contact : contacts) {
      contact.p_OC *= small.torque_scale;
      contact.torsion *= small.torque_scale;
    }
    EXPECT_NEAR(CalcEpsilonOf(contacts, small), epsilon, 1e-9);
  }
}

TEST(EpsilonRelations, NeverLessForMoreFrictionContactsOrEdges) {
  RandomStream stream("epsilon fast", "growth");
  int num_grown = 0;
  for (int i = 0; i < 40; ++i) {
    std::vector<GraspContact> contacts = MakeRandomGrasp(stream, 5);
    const double epsilon = CalcEpsilonOf(contacts);

    WrenchSpace more_edges;
    more_edges.num_edges = 16;
    EXPECT_GE(CalcEpsilonOf(contacts, more_edges), epsilon - 1e-9);

    std::vector<GraspContact> rougher = contacts;
    for (GraspContact& contact : rougher) contact.mu *= 1.2;
    const double rough_epsilon = CalcEpsilonOf(rougher);
    EXPECT_GE(rough_epsilon, epsilon - 1e-9);
    num_grown += rough_epsilon > epsilon + 1e-3;

    contacts.push_back(MakeRandomGrasp(stream, 1).front());
    EXPECT_GE(CalcEpsilonOf(contacts), epsilon - 1e-9);
  }
  EXPECT_GT(num_grown, 15);
}

// A joggled or rounded hull would show a tiny positive number here.
TEST(EpsilonRelations, HardPinchIsExactlyZeroInEveryPose) {
  RandomStream stream("epsilon fast", "pinch");
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d R = MakeRandomRotation(stream);
    const std::vector<GraspContact> pinch = Move(MakePinch(stream.NextUniform(0.01, 1.0), 0.9, 0.0),
                                                 R, 0.2 * MakeRandomDirection(stream));
    WrenchSpace space;
    space.torque_scale = 0.05;
    EXPECT_EQ(CalcEpsilonOf(pinch, space), 0.0);
    EXPECT_EQ(CalcEpsilon(CalcWrenchHull(CalcConeWrenches(pinch, space).wrenches)), 0.0);
  }
}

}  // namespace
}  // namespace graspbench
