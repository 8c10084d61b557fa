#include "core/quality/force_closure.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/quality/linear_program.h"
#include "core/quality/wrench_hull.h"
#include "tests/core/quality/grasp_samples.h"

namespace graspbench {
namespace {

using Wrench = Eigen::Matrix<double, 6, 1>;

// A set has the origin inside if weights balance it (W lambda = 0) that are all at least some t >
// 0, and it fills all dimensions. As a program: lambda = mu + t, maximise t with sum mu + N t <= 1.
bool HasOriginInside(const WrenchMatrix& wrenches) {
  const Eigen::Index n = wrenches.cols();
  Eigen::MatrixXd A(13, n + 1);
  A.topRows(6) << wrenches, wrenches.rowwise().sum();
  A.middleRows(6, 6) = -A.topRows(6);
  A.row(12) << Eigen::RowVectorXd::Ones(n), n;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(13);
  b[12] = 1.0;
  const LinearProgramResult result = SolveLinearProgram(A, b, Eigen::VectorXd::Unit(n + 1, n));
  return result.value > 1e-9 && Eigen::FullPivLU<WrenchMatrix>(wrenches).rank() == 6;
}

TEST(ForceClosure, AgreesWithALinearProgram) {
  RandomStream stream("force closure", "program");
  int num_closed = 0;
  for (int i = 0; i < 100; ++i) {
    const WrenchMatrix wrenches =
        CalcConeWrenches(MakeRandomGrasp(stream, 2 + stream.NextIndex(4)), {}).wrenches;
    const bool is_closed = IsForceClosure(wrenches);
    ASSERT_EQ(is_closed, HasOriginInside(wrenches)) << "grasp " << i;
    num_closed += is_closed;
  }
  EXPECT_GT(num_closed, 20);
  EXPECT_LT(num_closed, 80);
}

// Three hard fingers around a sphere close it if their tripod lies flat enough in the cones.
TEST(ForceClosure, TripodOnASphere) {
  for (const double height : {0.3, 0.45, 0.55, 0.7}) {
    std::vector<GraspContact> contacts;
    for (const double angle_deg : {0.0, 120.0, 240.0}) {
      const double r = std::sqrt(1.0 - height * height), angle = RadFromDeg(angle_deg);
      const Eigen::Vector3d p(r * std::cos(angle), r * std::sin(angle), height);
      contacts.push_back({p, -p, 0.5, 0.0, Eigen::Vector3d::UnitZ()});
    }
    // A force level with the plane of the contacts must lie in every cone: height / r < mu.
    const bool is_closed = height / std::sqrt(1.0 - height * height) < 0.5;
    EXPECT_EQ(IsForceClosure(CalcConeWrenches(contacts, {}).wrenches), is_closed) << height;
  }
}

// Two opposite hard contacts at +-a on x: forces give 2, 2, 2 (squared), moments about y and z
// 2 (a / rho)^2, about x nothing; a pad adds two unit moments about x. Singular values are the
// roots.
TEST(MinSingularValue, PinchByHand) {
  WrenchSpace space;
  space.torque_scale = 0.1;
  std::vector<GraspContact> contacts{{{0.03, 0, 0}, {-1, 0, 0}, 0.5, 0.0, std::nullopt},
                                     {{-0.03, 0, 0}, {1, 0, 0}, 0.5, 0.0, std::nullopt}};
  EXPECT_EQ(CalcMinSingularValue(CalcGraspMatrix(contacts, space)), 0.0);
  for (GraspContact& contact : contacts) contact.torsion = 0.002;
  EXPECT_NEAR(CalcMinSingularValue(CalcGraspMatrix(contacts, space)), std::sqrt(2.0) * 0.3, 1e-12);
  EXPECT_EQ(CalcMinSingularValue(CalcGraspMatrix({contacts[0]}, space)), 0.0);
}

// A cube held at six face centres, rho = a: G G^T = diag(6, 6, 6, 4, 4, 4).
TEST(MinSingularValue, CubeByHand) {
  WrenchSpace space;
  space.torque_scale = 0.02;
  EXPECT_NEAR(CalcMinSingularValue(CalcGraspMatrix(MakeCubeGrasp(0.02, 0.5), space)), 2.0, 1e-12);
}

// Squeezing along x, friction carries a load along y: mu N with N the sum of both normal forces.
// Along the squeeze only one finger pushes. A moment about the line between the pads is held by
// torsion.
TEST(TaskForce, PinchByHand) {
  constexpr double kMu = 0.4, kTorsion = 0.003;
  WrenchSpace space;
  space.torque_scale = 0.05;
  std::vector<GraspContact> contacts{
      {{0.03, 0, 0}, {-1, 0, 0}, kMu, kTorsion, Eigen::Vector3d::UnitY()},
      {{-0.03, 0, 0}, {1, 0, 0}, kMu, kTorsion, Eigen::Vector3d::UnitY()}};
  const ConeWrenches cones = CalcConeWrenches(contacts, space);
  EXPECT_NEAR(CalcTaskForce(cones, Wrench::Unit(1), ForceLimit::kSum), kMu, 1e-12);
  EXPECT_NEAR(CalcTaskForce(cones, Wrench::Unit(1), ForceLimit::kEach), 2.0 * kMu, 1e-12);
  EXPECT_NEAR(CalcTaskForce(cones, -Wrench::Unit(2), ForceLimit::kEach), 2.0 * kMu, 1e-12);
  EXPECT_NEAR(CalcTaskForce(cones, Wrench::Unit(0), ForceLimit::kSum), 1.0, 1e-12);
  EXPECT_NEAR(CalcTaskForce(cones, Wrench::Unit(0), ForceLimit::kEach), 1.0, 1e-12);
  EXPECT_NEAR(CalcTaskForce(cones, Wrench::Unit(3), ForceLimit::kSum), kTorsion / 0.05, 1e-12);
  EXPECT_NEAR(CalcTaskForce(cones, Wrench::Unit(3), ForceLimit::kEach), 2 * kTorsion / 0.05, 1e-12);
  // A couple about z: both fingers rub in opposite directions at the lever 0.03 m.
  EXPECT_NEAR(CalcTaskForce(cones, Wrench::Unit(5), ForceLimit::kSum), kMu * 0.03 / 0.05, 1e-12);
}

TEST(TaskForce, NothingHoldsAgainstTheOnlyFinger) {
  const ConeWrenches cones =
      CalcConeWrenches({{{0.03, 0, 0}, {-1, 0, 0}, 0.5, 0.0, std::nullopt}}, {});
  EXPECT_NEAR(CalcTaskForce(cones, -Wrench::Unit(0), ForceLimit::kSum), 1.0, 1e-12);
  EXPECT_EQ(CalcTaskForce(cones, Wrench::Unit(0), ForceLimit::kSum), 0.0);
  EXPECT_EQ(CalcTaskForce({}, Wrench::Unit(0), ForceLimit::kSum), 0.0);
}

// Two spheres of one pad touch at nearly one point; all contacts lie in a plane. Rounding then looks
// like a way to infinity. Whatever touches besides can only help, and what touches where something
// does already helps no more than by the distance; a program whose
// bounds were widened by 1e-8 is off by that times its prices.
TEST(TaskForce, ContactsThatNearlyCoincide) {
  RandomStream stream("task force", "coincide");
  for (int i = 0; i < 4000; ++i) {
    std::vector<GraspContact> contacts = MakeRandomGrasp(stream, 3 + stream.NextIndex(4));
    for (GraspContact& contact : contacts) contact.p_OC.z() = 0.0;
    const ConeWrenches before = CalcConeWrenches(contacts, {});
    const size_t num_contacts = contacts.size();
    const double distance = std::pow(10.0, stream.NextUniform(-9.0, -6.0));
    for (int copy = 0; copy < 4; ++copy) {
      GraspContact contact = contacts[stream.NextIndex(num_contacts)];
      contact.p_OC += distance * MakeRandomDirection(stream);
      contacts.push_back(contact);
    }
    const ConeWrenches after = CalcConeWrenches(contacts, {});
    for (int axis = 0; axis < 6; ++axis) {
      const double old_force = CalcTaskForce(before, Wrench::Unit(axis), ForceLimit::kSum);
      const double new_force = CalcTaskForce(after, Wrench::Unit(axis), ForceLimit::kSum);
      ASSERT_GE(new_force, old_force - 1e-5) << "grasp " << i << ", axis " << axis;
      ASSERT_LE(new_force, old_force + 100.0 * distance + 1e-5)
          << "grasp " << i << ", axis " << axis;
    }
  }
}

// With the sum limited it is the distance to the hull along the direction, by Qhull's facets; never
// below epsilon; with each contact limited never below that, never above that times the contacts.
TEST(TaskForce, IsTheDistanceToTheHull) {
  RandomStream stream("task force", "hull");
  int num_closed = 0;
  for (int i = 0; i < 40; ++i) {
    const int num_contacts = 3 + stream.NextIndex(4);
    const ConeWrenches cones = CalcConeWrenches(MakeRandomGrasp(stream, num_contacts), {});
    const WrenchHull hull = CalcWrenchHull(cones.wrenches);
    const double epsilon = CalcEpsilon(hull);
    if (epsilon == 0.0) continue;
    ++num_closed;
    for (int k = 0; k < 6; ++k) {
      Wrench direction;
      for (double& value : direction) value = stream.NextNormal();
      direction.normalize();
      if (k < 2) direction = Wrench::Unit(stream.NextIndex(6));
      double distance = 1e300;
      for (int facet = 0; facet < hull.offsets.size(); ++facet) {
        const double slope = hull.normals.col(facet).dot(direction);
        if (slope > 1e-12) distance = std::min(distance, hull.offsets[facet] / slope);
      }
      const double sum_limited = CalcTaskForce(cones, direction, ForceLimit::kSum);
      const double each_limited = CalcTaskForce(cones, direction, ForceLimit::kEach);
      ASSERT_NEAR(sum_limited, distance, 1e-8 * (1.0 + distance));
      ASSERT_GE(sum_limited, epsilon - 1e-9);
      ASSERT_GE(each_limited, sum_limited - 1e-9);
      ASSERT_LE(each_limited, num_contacts * sum_limited + 1e-9);
    }
  }
  EXPECT_GT(num_closed, 10);
}

}  // namespace
}  // namespace graspbench
