#include "core/quality/grasp_quality.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/quality/epsilon_fast.h"
#include "core/quality/linear_program.h"
#include "core/quality/wrench_hull.h"
#include "tests/core/quality/grasp_samples.h"

namespace graspbench {
namespace {

QualityRequest MakeRequest(std::vector<GraspContact> contacts, const std::string& convention,
                           double torque_scale) {
  QualityRequest request;
  request.contacts = std::move(contacts);
  request.convention = FindQualityConvention(convention);
  request.torque_scale = torque_scale;
  return request;
}

double CalcEpsilonBy(const std::string& convention, const std::vector<GraspContact>& contacts,
                     double torque_scale) {
  return CalcGraspQuality(MakeRequest(contacts, convention, torque_scale)).epsilon;
}

// The cube of half-edge a, six face centres, eight edges, mu 0.5: epsilon = mu sqrt(2/3) with unit
// normal force and rho = a. The other conventions follow from it by hand.
TEST(GraspQuality, OneGraspUnderEveryConvention) {
  constexpr double kA = 0.02, kMu = 0.5;
  const std::vector<GraspContact> cube = MakeCubeGrasp(kA, kMu);
  const double epsilon = kMu * std::sqrt(2.0 / 3.0);
  EXPECT_NEAR(CalcEpsilonBy("ferrari-canny", cube, kA), epsilon, 1e-9);
  EXPECT_NEAR(CalcEpsilonBy("graspit", cube, kA), epsilon, 1e-9);
  EXPECT_NEAR(CalcEpsilonBy("dex-net", cube, kA), epsilon, 1e-9);
  // Unit total force shortens every edge by the same factor; the hull's centre is the origin.
  EXPECT_NEAR(CalcEpsilonBy("simox", cube, kA), epsilon / std::sqrt(1.0 + kMu * kMu), 1e-9);
  // Half the friction; the contacts' centroid is the centre, their mean distance from it is a.
  EXPECT_NEAR(CalcEpsilonBy("dexgraspbench", cube, 7.0), 2.0 - epsilon / 2.0, 1e-9);
  // Moments in N m and four edges; unit total force shortens as above.
  QualityRequest unscaled = MakeRequest(cube, "ferrari-canny", 1.0);
  unscaled.num_edges = 4;
  EXPECT_NEAR(CalcEpsilonBy("frogger", cube, 7.0),
              CalcGraspQuality(unscaled).epsilon / std::sqrt(1.0 + kMu * kMu), 1e-12);
}

TEST(GraspQuality, WithoutClosureEachConventionSaysSoInItsWay) {
  const std::vector<GraspContact> pinch = MakePinch(0.03, 0.5, 0.0);
  EXPECT_EQ(CalcEpsilonBy("ferrari-canny", pinch, 0.03), 0.0);
  EXPECT_EQ(CalcEpsilonBy("graspit", pinch, 0.03), -1.0);
  EXPECT_EQ(CalcEpsilonBy("simox", pinch, 0.03), 0.0);
  EXPECT_EQ(CalcEpsilonBy("dexgraspbench", pinch, 0.03), 2.0);
  EXPECT_EQ(CalcEpsilonBy("dex-net", pinch, 0.03), 0.0);
  EXPECT_EQ(CalcEpsilonBy("frogger", pinch, 0.03), -1.0);
  // Measured from the hull's own centre, a grasp that cannot close still gets a positive number.
  std::vector<GraspContact> one_sided = MakePinch(1.0, 0.5, 0.2);
  one_sided[1].nhat_O *= -1.0;
  const GraspQuality simox = CalcGraspQuality(MakeRequest(one_sided, "simox", 1.0));
  EXPECT_FALSE(simox.force_closure);
  EXPECT_GT(simox.epsilon, 0.0);
}

// Three hard contacts that pull one way cannot close; with the origin their wrenches still span a
// cone.
TEST(GraspQuality, TheOriginCountsInTheVolumeOfAnOpenGrasp) {
  const std::vector<GraspContact> contacts{{{1, 0, 0}, {0, 0, 1}, 0.5, 0.0, std::nullopt},
                                           {{-1, 1, 0}, {0, 0, 1}, 0.5, 0.0, std::nullopt},
                                           {{-1, -1, 0}, {0, 0.6, 0.8}, 0.5, 0.0, std::nullopt}};
  const GraspQuality ours = CalcGraspQuality(MakeRequest(contacts, "ferrari-canny", 1.0));
  const GraspQuality graspit = CalcGraspQuality(MakeRequest(contacts, "graspit", 1.0));
  EXPECT_FALSE(ours.force_closure);
  EXPECT_EQ(ours.epsilon, 0.0);
  EXPECT_GT(ours.volume, 1.1 * graspit.volume);
  EXPECT_GT(graspit.volume, 0.0);
}

TEST(GraspQuality, AllMeasuresOfACube) {
  constexpr double kA = 0.02, kMu = 0.5;
  const GraspQuality quality =
      CalcGraspQuality(MakeRequest(MakeCubeGrasp(kA, kMu), "ferrari-canny", kA));
  EXPECT_TRUE(quality.force_closure);
  EXPECT_NEAR(quality.volume, 0.598634, 6e-7);
  EXPECT_NEAR(quality.min_singular_value, 2.0, 1e-12);
  ASSERT_EQ(quality.task_forces.size(), 12u);
  EXPECT_EQ(quality.task_forces[0].direction, "force +x");
  // One face pushes with 1 N. With 1 N at each contact: that, and friction at the four side faces.
  EXPECT_NEAR(quality.task_forces[0].sum_limited, 1.0, 1e-9);
  EXPECT_NEAR(quality.task_forces[0].each_limited, 1.0 + 4.0 * kMu, 1e-9);
  // A moment: four faces rub around the axis, each with mu a.
  EXPECT_EQ(quality.task_forces[11].direction, "moment -z");
  EXPECT_NEAR(quality.task_forces[11].sum_limited, kMu * kA, 1e-9);
  EXPECT_NEAR(quality.task_forces[11].each_limited, 4.0 * kMu * kA, 1e-9);
  ASSERT_TRUE(quality.weakest_wrench.has_value());
  const ConeWrenches cones = CalcConeWrenches(MakeCubeGrasp(kA, kMu), quality.space);
  EXPECT_NEAR((quality.weakest_wrench->transpose() * cones.wrenches).maxCoeff(), quality.epsilon,
              1e-9);
  EXPECT_EQ(
      quality.description,
      "ferrari-canny: epsilon = distance of the origin from the hull, 0 without force closure; "
      "hull of the union of all cone edges (L1) and the origin, unit normal force; 8 edges; "
      "friction and torsion x 1; moments about (0, 0, 0) m, divided by 0.02 m (as given; meant: "
      "largest distance of the surface from the centre of mass)");
}

TEST(GraspQuality, TellsEveryProblem) {
  QualityRequest request = MakeRequest(MakePinch(0.03, 0.5, 0.0), "ferrari-canny", 0.05);
  EXPECT_TRUE(ListProblems(request).empty());
  request.torque_scale.reset();
  request.num_edges = 2;
  request.contacts[1].mu = -0.5;
  request.p_OR.x() = 1000.0;
  const std::vector<std::string> expected{
      "contacts[1]: the friction coefficient is -0.5; expected 0 to 100",
      "edges: found 2, expected 3 to 64", "reference_m: expected three numbers within 100 m",
      "torque_scale_m: missing; the convention ferrari-canny needs a length to divide moments by "
      "(as given; meant: largest distance of the surface from the centre of mass)"};
  EXPECT_EQ(ListProblems(request), expected);

  request = MakeRequest(std::vector<GraspContact>(11, request.contacts[0]), "graspit", 0.05);
  request.num_edges = 60;
  EXPECT_EQ(ListProblems(request).front(),
            "contacts and edges: found 11 x 60 cone edges, expected at most 640; their exact hull "
            "would take minutes");

  request = MakeRequest(MakePinch(0.03, 0.5, 0.0), "dexgraspbench", 0.05);
  request.torque_scale.reset();
  EXPECT_TRUE(ListProblems(request).empty());
  request.contacts[1].p_OC = request.contacts[0].p_OC;
  EXPECT_EQ(ListProblems(request).front(),
            "contacts: all lie in one point; the convention dexgraspbench divides moments by their "
            "mean distance");
  request.contacts.pop_back();
  EXPECT_EQ(ListProblems(request).front(), "contacts: found 1, expected 2 to 64");
}

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
    const bool is_closed = CalcEpsilonBounds(wrenches).lower > 0.0;
    ASSERT_EQ(is_closed, HasOriginInside(wrenches)) << "grasp " << i;
    num_closed += is_closed;
  }
  EXPECT_GT(num_closed, 20);
  EXPECT_LT(num_closed, 80);
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
