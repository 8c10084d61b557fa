#include "core/quality/smallest_grip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kArm = 0.02, kMu = 0.4, kWeight = 1.2;

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

// A sample of forces that bear the weight never needs less than the optimum.
TEST(SmallestGrip, NoForcesFoundByChanceAreSmaller) {
  const LoadedGrasp grasp = MakeGrasp({0.012, -0.004});
  const double smallest = Calc(grasp);
  RandomStream random("smallest grip", "test");
  for (int i = 0; i < 2000; ++i) {
    // Digits 1 and 2 press a and b, the free one a + b; friction along z only, within the cones.
    const double a = random.NextUniform(0.0, 4.0), b = random.NextUniform(0.0, 4.0);
    const double carried = kMu * 2.0 * (a + b);
    const double moment = std::abs(0.012 * a - 0.004 * b);
    if (carried < kWeight || moment > 0.0) continue;
    EXPECT_GE(std::max(a, b), smallest - 1e-9);
  }
  EXPECT_GE(smallest, kWeight / (2.0 * kMu) / 2.0 - 1e-9);  // equal shares at best
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
