#include "reports/scenes/instant_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/reports/made_trial.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

HandContact MakeContact(const Vector3d& nhat_W, double mu) {
  HandContact contact;
  contact.nhat_W = nhat_W;
  contact.normal_force = 2.0;
  contact.mu = mu;
  return contact;
}

/** Of a closed surface, by the divergence theorem. */
double CalcEnclosed(const TriMesh& mesh) {
  double sum = 0.0;
  for (const Eigen::Vector3i& corner : mesh.triangles) {
    const Vector3d& a = mesh.vertices[static_cast<size_t>(corner[0])];
    const Vector3d& b = mesh.vertices[static_cast<size_t>(corner[1])];
    const Vector3d& c = mesh.vertices[static_cast<size_t>(corner[2])];
    sum += a.dot(b.cross(c));
  }
  return sum / 6.0;
}

constexpr double kCubicMetresPerNewton = 0.04 * 0.04 * 0.04;

// One contact gives its pyramid: a regular octagon of radius mu at a height of one newton.
TEST(ForceSpace, OfOneContactIsItsPyramid) {
  const double mu = 0.5;
  const auto scene = MakeForceSpaceScene({MakeContact(Vector3d(0.6, 0.0, 0.8), mu)});
  ASSERT_TRUE(scene);
  EXPECT_FALSE(scene->has_table);
  const double volume = 2.0 * std::sqrt(2.0) * mu * mu / 3.0;
  EXPECT_NEAR(CalcEnclosed(*scene->drawables[0].mesh) / kCubicMetresPerNewton, volume, 1e-9);
  for (const Vector3d& p : scene->drawables[0].mesh->vertices) {
    EXPECT_LE(p.norm(), kForceSpaceRadius);
  }
}

// Contacts without friction from all six sides: an octahedron of one newton.
TEST(ForceSpace, OfSixSidesIsAnOctahedron) {
  std::vector<HandContact> contacts;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      contacts.push_back(MakeContact(sign * Vector3d::Unit(axis), 0.0));
    }
  }
  const auto scene = MakeForceSpaceScene(contacts);
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->drawables[0].mesh->num_triangles(), 8);
  EXPECT_NEAR(CalcEnclosed(*scene->drawables[0].mesh) / kCubicMetresPerNewton, 4.0 / 3.0, 1e-9);
}

TEST(ForceSpace, IsNothingWithoutVolume) {
  EXPECT_FALSE(MakeForceSpaceScene({}));
  const HandContact left = MakeContact(Vector3d::UnitX(), 0.0);
  const HandContact right = MakeContact(-Vector3d::UnitX(), 0.0);
  EXPECT_FALSE(MakeForceSpaceScene({left, right}));
  EXPECT_FALSE(MakeForceSpaceScene({left, right, left, right, left}));
}

TEST(ContactMarks, AreTheContactsAndTheLargestForceIsTheLongestArrow) {
  TraceInstant instant;
  instant.contacts = {MakeContact(Vector3d::UnitZ(), 0.4), MakeContact(Vector3d::UnitX(), 0.3)};
  instant.contacts[1].friction_W = Vector3d(0.0, 1.5, 0.0);
  instant.contacts[1].is_at_limit = true;
  instant.contacts[1].slip_speed = 0.01;
  const std::vector<ContactMark> marks = MakeContactMarks(instant);
  ASSERT_EQ(marks.size(), 2u);
  EXPECT_FALSE(marks[0].is_sliding);
  EXPECT_TRUE(marks[1].is_sliding);
  EXPECT_EQ(marks[1].force_W, Vector3d(2.0, 1.5, 0.0));
  EXPECT_EQ(marks[1].mu, 0.3);
  TracedTrial traced;
  EXPECT_EQ(FindArrowScale(traced), 0.0);
  traced.trace = {instant};
  EXPECT_DOUBLE_EQ(FindArrowScale(traced) * 2.5, 0.045);
}

}  // namespace
}  // namespace graspbench
