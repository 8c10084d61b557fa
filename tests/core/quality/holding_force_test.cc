#include "core/quality/holding_force.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/pose.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/quality/linear_program.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kArm = 0.02, kMu = 0.5, kForce = 3.0;
constexpr double kGap = 1e-3;  // twice the sum of gaps that the header states

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
  // Friction is a circle.
  const Vector3d between(0.0, std::cos(kPi / 8.0), std::sin(kPi / 8.0));
  EXPECT_NEAR(CalcHoldingForce(grasp, between), 2.0 * kMu * kForce, kGap * kForce);
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
TEST(HoldingForce, ContactsThatPressWithNothingHoldNothing) {
  LoadedGrasp grasp = MakeLoadedPinch();
  grasp.weight = Vector3d(0, 0, -1);
  grasp.normal_forces = {0.0, 0.0};
  EXPECT_EQ(CalcHoldingForce(grasp, Vector3d::UnitZ()), 0.0);
  EXPECT_EQ(CalcWeakestHoldingForce(grasp, {Vector3d::UnitZ(), Vector3d::UnitX()}), 0.0);
}

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
    EXPECT_NEAR(CalcHoldingForce(turned, R * d), before, 1e-3 * before + 1e-9);
    LoadedGrasp mirrored = grasp, permuted = grasp;
    const Eigen::Matrix3d mirror = Vector3d(-1, 1, 1).asDiagonal();
    for (GraspContact& contact : mirrored.contacts) {
      contact.p_OC = mirror * contact.p_OC;
      contact.nhat_O = mirror * contact.nhat_O;
    }
    mirrored.weight = mirror * grasp.weight;
    EXPECT_NEAR(CalcHoldingForce(mirrored, mirror * d), before, 1e-3 * before + 1e-9);
    std::reverse(permuted.contacts.begin(), permuted.contacts.end());
    std::reverse(permuted.normal_forces.begin(), permuted.normal_forces.end());
    std::reverse(permuted.digits.begin(), permuted.digits.end());
    EXPECT_NEAR(CalcHoldingForce(permuted, d), before, 1e-3 * before + 1e-9);
    const std::vector<Vector3d> axes = {d, -d, d.unitOrthogonal()};
    const std::vector<double> forces = CalcHoldingForces(grasp, axes);
    EXPECT_NEAR(CalcWeakestHoldingForce(grasp, axes),
                *std::min_element(forces.begin(), forces.end()), 1e-9);
    for (double& force : doubled.normal_forces) force *= 2.0;
    doubled.weight *= 2.0;
    EXPECT_NEAR(CalcHoldingForce(doubled, d), 2.0 * before, 1e-9);
    for (GraspContact& contact : rough.contacts) contact.mu *= 1.3;
    EXPECT_GE(CalcHoldingForce(rough, d), (1.0 - 1e-3) * before - 1e-9);
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
  EXPECT_NEAR(Calc(grasp), 7.0 * before, 1e-6 * 7.0 * before);
}

// Neither the numbering of contacts, nor left and right, nor the length of everything changes a
// force: moments grow with the size, and the same forces bear the same weight.
TEST(SmallestGrip, MirroredPermutedAndScaledScenesNeedTheSame) {
  LoadedGrasp grasp = MakeGrasp({0.012, -0.005});
  grasp.contacts[1].nhat_O = Vector3d(-1.0, 0.2, 0.1).normalized();
  for (GraspContact& contact : grasp.contacts) {
    contact.torsion = kMu * 0.003;
    contact.first_edge_O.reset();
  }
  grasp.normal_forces = {4.0, 2.0, 2.0};
  const double before = Calc(grasp), pull = CalcHoldingForce(grasp, Vector3d::UnitZ());
  ASSERT_GT(before, 0.0);
  LoadedGrasp mirrored = grasp, permuted = grasp, scaled = grasp;
  for (GraspContact& contact : mirrored.contacts) {
    contact.p_OC.y() *= -1.0;
    contact.nhat_O.y() *= -1.0;
  }
  EXPECT_NEAR(Calc(mirrored), before, 1e-4 * before);
  std::reverse(permuted.contacts.begin() + 1, permuted.contacts.end());
  EXPECT_NEAR(Calc(permuted), before, 1e-4 * before);
  scaled.radius *= 3.0;
  for (GraspContact& contact : scaled.contacts) {
    contact.p_OC *= 3.0;
    contact.torsion *= 3.0;
  }
  EXPECT_NEAR(Calc(scaled), before, 1e-4 * before);
  EXPECT_NEAR(CalcHoldingForce(scaled, Vector3d::UnitZ()), pull, 1e-3 * pull + 1e-9);
}

/** A block between two hard fingers on its middle, their line inclined by `tilt`: digit 0 below,
digit 1 above. */
LoadedGrasp MakeTiltedPinch(double tilt, double mu, double weight) {
  LoadedGrasp grasp;
  grasp.radius = std::sqrt(3.0) * kArm;
  const Vector3d up_the_line(std::cos(tilt), 0.0, std::sin(tilt));
  grasp.weight = Vector3d(0.0, 0.0, -weight);
  grasp.contacts = {{-kArm * up_the_line, up_the_line, mu, 0.0, std::nullopt},
                    {kArm * up_the_line, -up_the_line, mu, 0.0, std::nullopt}};
  grasp.normal_forces = {0.0, 0.0};
  grasp.digits = {0, 1};
  return grasp;
}

// With the forces f_1 = w/2 + N a below and f_2 = w/2 - N a above along the line a (then moments
// balance), friction bears w/2 cos(tilt) at each, and slips above, where the normal force is less:
// N_2 = w/2 cos(tilt) / mu, N_1 = N_2 + w sin(tilt). Block of 0.15 kg.
TEST(SmallestGrip, TiltedPinchInClosedForm) {
  const double weight = 0.15 * kStandardGravity, mu = 0.45;
  for (const double tilt_deg : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0}) {
    const double tilt = RadFromDeg(tilt_deg);
    const LoadedGrasp grasp = MakeTiltedPinch(tilt, mu, weight);
    const double upper = 0.5 * weight * std::cos(tilt) / mu;
    const double lower = upper + weight * std::sin(tilt);
    EXPECT_NEAR(CalcSmallestGrip(grasp, {true, false}).value_or(kUnset), upper, 1e-3 * upper);
    EXPECT_NEAR(CalcSmallestGrip(grasp, {false, true}).value_or(kUnset), lower, 1e-3 * lower);
  }
}

// Pinched beside the centre of mass, at the distance e across the line: soft fingers bear the
// moment w e about it, friction and moment together by the ellipsoid:
// F = w / (2 mu) sqrt(1 + (e / r)^2). What hard ones cannot bear their patches do, up to 3 % of
// 2 F radius.
TEST(SmallestGrip, SoftPinchBesideTheCentreOfMass) {
  LoadedGrasp grasp = MakeGrasp({0.0});
  const double r = 0.004;
  for (const double e : {0.001, 0.003, 0.006}) {
    for (GraspContact& contact : grasp.contacts) {
      contact.p_OC.y() = e;
      contact.torsion = kMu * r;
    }
    grasp.radius = 0.02;
    const double expected = kWeight / (2.0 * kMu) * std::hypot(1.0, e / r);
    EXPECT_NEAR(Calc(grasp), expected, 2e-3 * expected) << e;
  }
  for (GraspContact& contact : grasp.contacts) contact.torsion = 0.0;
  const double by_patches = kWeight * 0.006 / (2.0 * 0.03 * 0.02);
  EXPECT_NEAR(Calc(grasp), by_patches, 1e-3 * by_patches);
}

// Three hard fingers at thirds of a circle, all pressing alike: each bears a third of the weight.
TEST(SmallestGrip, ThreeFingersAroundACylinder) {
  LoadedGrasp grasp;
  grasp.radius = 0.03;
  grasp.weight = Vector3d(0.0, 0.0, -kWeight);
  for (int i = 0; i < 3; ++i) {
    const double angle = 2.0 * kPi * i / 3.0 + 0.4;
    const Vector3d n(-std::cos(angle), -std::sin(angle), 0.0);
    grasp.contacts.push_back({-0.02 * n, n, kMu, 0.0, std::nullopt});
    grasp.normal_forces.push_back(0.0);
    grasp.digits.push_back(i);
  }
  EXPECT_NEAR(CalcSmallestGrip(grasp, {false, false, false}).value_or(kUnset),
              kWeight / (3.0 * kMu), 1e-3 * kWeight);
}

/** The same program by many generators spread over each cone, those of friction at `num` angles,
and by the simplex method alone: a lower bound of what the contacts can do. */
double CalcGripByManyGenerators(const LoadedGrasp& grasp, const std::vector<bool>& is_free,
                                int num) {
  const double weight = grasp.weight.norm();
  std::vector<VectorXd> columns;
  std::vector<double> gains;
  const int num_digits = *std::max_element(grasp.digits.begin(), grasp.digits.end()) + 1;
  const Eigen::Index num_rows = 14 + num_digits;
  const auto for_each_direction = [&](bool is_ball, auto&& f) {
    const int num_rings = is_ball ? num / 4 : 0;
    for (int ring = -num_rings; ring <= num_rings; ++ring) {
      const double height = num_rings > 0 ? 0.5 * kPi * ring / num_rings : 0.0;
      for (int k = 0; k < num; ++k) {
        const double angle = 2.0 * kPi * k / num;
        f(Vector3d(std::cos(height) * std::cos(angle), std::cos(height) * std::sin(angle),
                   std::sin(height)));
      }
    }
  };
  const auto add = [&](const Vector3d& force, const Vector3d& moment, double tolerated, int digit,
                       double gain) {
    VectorXd column = VectorXd::Zero(num_rows);
    column << force, moment / grasp.radius, -force, -moment / grasp.radius, tolerated,
        VectorXd::Zero(num_digits + 1);
    if (digit >= 0) column[14 + digit] = 1.0;
    columns.push_back(column);
    gains.push_back(gain);
  };
  add(grasp.weight / weight, Vector3d::Zero(), 0.0, -1, 1e3);
  columns[0][13] = 1.0;
  add(Vector3d::Zero(), Vector3d::Zero(), 0.0, -1, -1.0);
  columns[1].tail(num_digits).setConstant(-1.0);
  for_each_direction(
      true, [&](const Vector3d& e) { add(Vector3d::Zero(), grasp.radius * e, 1.0, -1, -20.0); });
  for (size_t i = 0; i < grasp.contacts.size(); ++i) {
    const GraspContact& contact = grasp.contacts[i];
    const Vector3d n = contact.nhat_O, t = n.unitOrthogonal();
    for_each_direction(contact.torsion > 0.0, [&](const Vector3d& e) {
      const Vector3d f = n + contact.mu * (e.x() * t + e.y() * n.cross(t));
      add(f, contact.p_OC.cross(f) + contact.torsion * e.z() * n, -0.03,
          is_free[i] ? -1 : grasp.digits[i], -1e-3);
    });
  }
  Eigen::MatrixXd A(num_rows, static_cast<Eigen::Index>(columns.size()));
  for (size_t j = 0; j < columns.size(); ++j) A.col(static_cast<Eigen::Index>(j)) = columns[j];
  const LinearProgramResult result = SolveLinearProgram(
      A, VectorXd::Unit(num_rows, 13),
      Eigen::Map<VectorXd>(gains.data(), static_cast<Eigen::Index>(gains.size())));
  return result.x[0] < 1.0 - 1e-6 ? kUnset : weight * result.x[1];
}

// Hard contacts by 96 edges, soft ones by 24 x 13 generators, which lie at most 0.06 and 1.8 %
// inside their cones.
TEST(SmallestGrip, AgreesWithManyGenerators) {
  RandomStream random("1", "smallest grip");
  int num_borne = 0;
  for (int repeat = 0; repeat < 12; ++repeat) {
    const bool is_soft = repeat % 2 == 1;
    LoadedGrasp grasp;
    grasp.radius = 0.03;
    for (int i = 0; i < 4; ++i) {
      const double side = i % 2 == 0 ? 1.0 : -1.0;
      const Vector3d n =
          Vector3d(side, random.NextUniform(-0.4, 0.4), random.NextUniform(-0.4, 0.4)).normalized();
      const Vector3d p(-side * 0.02, random.NextUniform(-0.01, 0.01),
                       random.NextUniform(-0.01, 0.01));
      grasp.contacts.push_back({p, n, 0.5, is_soft ? 0.002 : 0.0, std::nullopt});
      grasp.normal_forces.push_back(0.0);
      grasp.digits.push_back(i);
    }
    grasp.weight = Vector3d(random.NextNormal(), random.NextNormal(), random.NextNormal());
    const std::vector<bool> is_free = {true, false, false, false};
    const double expected = CalcGripByManyGenerators(grasp, is_free, is_soft ? 24 : 96);
    const std::optional<double> grip = CalcSmallestGrip(grasp, is_free);
    if (std::isnan(expected)) continue;
    ASSERT_TRUE(grip);
    EXPECT_LE(*grip, (1.0 + 1e-3) * expected) << repeat;
    EXPECT_GE(*grip, (is_soft ? 0.96 : 0.997) * expected) << repeat;
    ++num_borne;
  }
  EXPECT_GE(num_borne, 8);
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
