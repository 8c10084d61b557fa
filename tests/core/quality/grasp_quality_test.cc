#include "core/quality/grasp_quality.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/quality/epsilon_fast.h"
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
}

// Measured from the hull's own centre, a grasp that cannot close at all still gets a positive
// number.
TEST(GraspQuality, SimoxMeasuresFromTheHullsCentre) {
  std::vector<GraspContact> pinch = MakePinch(1.0, 0.5, 0.2);
  pinch[1].nhat_O *= -1.0;
  const GraspQuality quality = CalcGraspQuality(MakeRequest(pinch, "simox", 1.0));
  EXPECT_FALSE(quality.force_closure);
  EXPECT_GT(quality.epsilon, 0.0);
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
      "largest "
      "distance of the surface from the centre of mass)");
}

// Normals written with seven digits are unit within 1e-6 only; the measures are those of true
// units.
TEST(GraspQuality, NormalsAreMadeUnit) {
  std::vector<GraspContact> cube = MakeCubeGrasp(0.02, 0.5);
  for (GraspContact& contact : cube) contact.nhat_O *= 1.0 + 9e-7;
  EXPECT_NEAR(CalcEpsilonBy("ferrari-canny", cube, 0.02), 0.5 * std::sqrt(2.0 / 3.0), 1e-12);
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

TEST(QualityConvention, UnknownNamesAreSuggested) {
  try {
    FindQualityConvention("grasp-it");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kNotFound);
    EXPECT_STREQ(error.what(),
                 "no quality convention \"grasp-it\"; did you mean \"graspit\"? Known: "
                 "ferrari-canny, graspit, simox, dexgraspbench, dex-net, frogger");
  }
}

}  // namespace
}  // namespace graspbench
