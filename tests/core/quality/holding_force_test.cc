#include "core/quality/holding_force.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/pose.h"
#include "core/base/random.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kArm = 0.02, kMu = 0.5, kForce = 3.0;

/** Two digits press with kForce each at +-kArm on the x axis. */
LoadedGrasp MakeLoadedPinch() {
  LoadedGrasp grasp;
  grasp.radius = kArm;
  for (const double side : {-1.0, 1.0}) {
    grasp.contacts.push_back(
        {Vector3d(side * kArm, 0, 0), Vector3d(-side, 0, 0), kMu, kMu * 0.004, Vector3d::UnitY()});
    grasp.normal_forces.push_back(kForce);
    grasp.digits.push_back(side > 0.0 ? 1 : 0);
  }
  return grasp;
}

double CalcHoldingForce(const LoadedGrasp& grasp, const Vector3d& direction) {
  return CalcHoldingForces(grasp, {direction.normalized()})[0];
}

// Across the line of the contacts both give mu F; along it one digit presses alone.
TEST(HoldingForce, APinchByHand) {
  const LoadedGrasp grasp = MakeLoadedPinch();
  EXPECT_NEAR(CalcHoldingForce(grasp, Vector3d::UnitY()), 2.0 * kMu * kForce, 1e-9);
  EXPECT_NEAR(CalcHoldingForce(grasp, -Vector3d::UnitZ()), 2.0 * kMu * kForce, 1e-9);
  EXPECT_NEAR(CalcHoldingForce(grasp, Vector3d::UnitX()), kForce, 1e-9);
  // Between two edges the octagon is cos 22.5 degrees as wide.
  const Vector3d between(0.0, std::cos(kPi / 8.0), std::sin(kPi / 8.0));
  EXPECT_NEAR(CalcHoldingForce(grasp, between), 2.0 * kMu * kForce * std::cos(kPi / 8.0), 1e-9);
}

TEST(HoldingForce, TheWeightIsPartOfTheLoad) {
  LoadedGrasp grasp = MakeLoadedPinch();
  grasp.weight = Vector3d(0.0, -1.2, 0.0);
  EXPECT_NEAR(CalcHoldingForce(grasp, -Vector3d::UnitY()), 2.0 * kMu * kForce - 1.2, 1e-9);
  EXPECT_NEAR(CalcHoldingForce(grasp, Vector3d::UnitY()), 2.0 * kMu * kForce + 1.2, 1e-9);
  grasp.weight = Vector3d(0.0, -3.1, 0.0);  // more than 2 mu F
  for (const Vector3d& d : {Vector3d(0, -1, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 1)}) {
    EXPECT_EQ(CalcHoldingForce(grasp, d), 0.0);
  }
}

// Pulled along the contacts' line, the digit in front carries the weight too, with its friction;
// the moment of that, weight * arm, must stay below the tolerance 0.03 * 2 F * radius, or the digit
// behind takes its share.
TEST(HoldingForce, MomentsAreBalancedButForTheTolerance) {
  LoadedGrasp grasp = MakeLoadedPinch();
  const double tolerated = 0.03 * 2.0 * kForce;
  grasp.weight = Vector3d(0.0, -tolerated, 0.0);
  EXPECT_NEAR(CalcHoldingForce(grasp, Vector3d::UnitX()), kForce, 1e-9);
  grasp.weight *= 2.0;
  // Friction t_front - t_behind = tolerated, t_front + t_behind = weight: t_behind = tolerated / 2,
  // for which the digit behind presses t_behind / mu against the pull.
  EXPECT_NEAR(CalcHoldingForce(grasp, Vector3d::UnitX()), kForce - 0.5 * tolerated / kMu, 1e-9);
}

TEST(HoldingForce, ADigitSharesItsForceAmongItsContacts) {
  LoadedGrasp grasp = MakeLoadedPinch();
  grasp.contacts.push_back(grasp.contacts[1]);
  grasp.contacts[1].p_OC.y() = 0.01;
  grasp.contacts[2].p_OC.y() = -0.01;
  grasp.digits.push_back(1);
  grasp.normal_forces = {kForce, kForce, 0.0};
  EXPECT_NEAR(CalcHoldingForce(grasp, Vector3d::UnitX()), kForce, 1e-9);
  grasp.digits[2] = 2;  // a digit that does not press: all of the force is off the centre
  EXPECT_LT(CalcHoldingForce(grasp, Vector3d::UnitX()), 0.7 * kForce);
}

TEST(HoldingForce, GrowsWithForceAndFrictionAndWithNothingElse) {
  RandomStream random("1", "holding force");
  for (int repeat = 0; repeat < 20; ++repeat) {
    LoadedGrasp grasp;
    grasp.radius = 0.03;
    for (int i = 0; i < 6; ++i) {
      const Vector3d n =
          Vector3d(random.NextNormal(), random.NextNormal(), random.NextNormal()).normalized();
      grasp.contacts.push_back({-0.03 * n, n, 0.6, 0.002, n.unitOrthogonal()});
      grasp.normal_forces.push_back(random.NextUniform(0.5, 2.0));
      grasp.digits.push_back(i / 2);
    }
    grasp.weight = Vector3d(0.1, -0.2, 0.1);
    const Vector3d d = Vector3d(random.NextNormal(), random.NextNormal(), 1.0).normalized();
    const double before = CalcHoldingForce(grasp, d);

    LoadedGrasp turned = grasp, doubled = grasp, rough = grasp;
    const Eigen::Matrix3d R = MakeRotationRpy(0.3, -0.8, 2.0);
    for (GraspContact& contact : turned.contacts) {
      contact = {R * contact.p_OC, R * contact.nhat_O, contact.mu, contact.torsion,
                 Vector3d(R * *contact.first_edge_O)};
    }
    turned.weight = R * grasp.weight;
    // The tolerance of moments is a box along the axes; a turned one differs a little.
    EXPECT_NEAR(CalcHoldingForce(turned, R * d), before, 0.15 * before + 1e-9);
    for (double& force : doubled.normal_forces) force *= 2.0;
    doubled.weight *= 2.0;
    EXPECT_NEAR(CalcHoldingForce(doubled, d), 2.0 * before, 1e-9);
    for (GraspContact& contact : rough.contacts) contact.mu *= 1.3;
    EXPECT_GE(CalcHoldingForce(rough, d), before - 1e-9);
  }
}

constexpr double kWeight = 1.2;  // of the smallest grip [N]

/** Digit 0 at -kArm on the x axis is free; the others press from +kArm at these y. */
LoadedGrasp MakeGrasp(const std::vector<double>& others) {
  LoadedGrasp grasp;
  grasp.radius = kArm;
  grasp.weight = Vector3d(0.0, 0.0, -kWeight);
  const auto add = [&](double x, double y, int digit) {
    grasp.contacts.push_back(
        {Vector3d(x, y, 0), Vector3d(x > 0.0 ? -1.0 : 1.0, 0, 0), kMu, 0.0, Vector3d::UnitZ()});
    grasp.normal_forces.push_back(0.0);
    grasp.digits.push_back(digit);
  };
  add(-kArm, 0.0, 0);
  for (const double y : others) add(kArm, y, static_cast<int>(grasp.digits.size()));
  return grasp;
}
std::vector<bool> FreeFirst(const LoadedGrasp& grasp) {
  std::vector<bool> is_free(grasp.contacts.size(), false);
  is_free.front() = true;
  return is_free;
}
double Calc(const LoadedGrasp& grasp) {
  return CalcSmallestGrip(grasp, FreeFirst(grasp)).value_or(kUnset);
}

// weight = 2 mu F, shared by as many as press on one side.
TEST(SmallestGrip, OpposedDigitsInClosedForm) {
  EXPECT_NEAR(Calc(MakeGrasp({0.0})), kWeight / (2.0 * kMu), 1e-9);
  EXPECT_NEAR(Calc(MakeGrasp({0.01, -0.01})), kWeight / (2.0 * kMu) / 2.0, 1e-9);
  EXPECT_NEAR(Calc(MakeGrasp({0.01, 0.0, -0.01})), kWeight / (2.0 * kMu) / 3.0, 1e-9);
}

TEST(SmallestGrip, IsProportionalToTheWeightAndKnowsNoFrame) {
  LoadedGrasp grasp = MakeGrasp({0.01, -0.01});
  const double before = Calc(grasp);
  grasp.weight *= 7.0;
  EXPECT_NEAR(Calc(grasp), 7.0 * before, 1e-8);
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(1.1, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (GraspContact& contact : grasp.contacts) {
    contact.p_OC = R * contact.p_OC;
    contact.nhat_O = R * contact.nhat_O;
    contact.first_edge_O = R * *contact.first_edge_O;
  }
  grasp.weight = R * grasp.weight;
  EXPECT_NEAR(Calc(grasp), 7.0 * before, 2e-3 * 7.0 * before);  // the tolerance is by axes
}

// From below the normals carry it and friction is not needed: one on each slope of a roof.
TEST(SmallestGrip, WhatLiesOnTheDigitsNeedsNoSqueeze) {
  LoadedGrasp grasp = MakeGrasp({0.0});
  for (GraspContact& contact : grasp.contacts) {
    contact.mu = 1e-6;
    contact.nhat_O = (contact.nhat_O + Vector3d::UnitZ()).normalized();
  }
  EXPECT_NEAR(Calc(grasp), kWeight / std::sqrt(2.0), 1e-4);
}

TEST(SmallestGrip, ContactsThatCannotBearItAreNamed) {
  LoadedGrasp one_sided = MakeGrasp({0.01, -0.01});
  one_sided.contacts.erase(one_sided.contacts.begin());
  one_sided.digits.erase(one_sided.digits.begin());
  EXPECT_FALSE(CalcSmallestGrip(one_sided, {false, false}));
  LoadedGrasp slippery = MakeGrasp({0.0});
  for (GraspContact& contact : slippery.contacts) contact.mu = 0.0;
  EXPECT_FALSE(CalcSmallestGrip(slippery, FreeFirst(slippery)));
  EXPECT_FALSE(CalcSmallestGrip(LoadedGrasp{{}, {}, {}, Vector3d(0, 0, -1), 0.02}, {}));
}

}  // namespace
}  // namespace graspbench
