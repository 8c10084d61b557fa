#include "core/hand/contact_protrusion.h"

#include <gtest/gtest.h>

#include "core/shape/primitives.h"

namespace graspbench {
namespace {

// A cylinder is contact as the capsule within it, so it sticks out of a shorter box at both ends.
TEST(ContactProtrusionTest, OfACapsuleBeyondABox) {
  CollisionShape cylinder;
  cylinder.kind = CollisionShape::Kind::kCylinder;
  cylinder.size = {0.02, 0.02, 0.1};
  const TriMesh box = MakeRoundedBox({0.02, 0.02, 0.09}, 0.0);
  EXPECT_NEAR(CalcContactProtrusion({cylinder}, {box}), 0.005, 1e-7);
  // Two meshes have one hull.
  TriMesh higher = box;
  for (Eigen::Vector3d& p : higher.vertices) p.z() += 0.003;
  EXPECT_NEAR(CalcContactProtrusion({cylinder}, {higher, box}), 0.005, 1e-7);
  EXPECT_NEAR(CalcContactProtrusion({cylinder}, {higher}), 0.008, 1e-7);
}

TEST(ContactProtrusionTest, OfAHandIsOfLinksWithContactAndPicture) {
  Hand hand;
  for (const char* name : {"palm", "unseen", "untouched"}) hand.links.emplace_back().name = name;
  hand.contact_spheres = {{0, {0.0, 0.0, 0.02}, 0.01}, {1, {0.0, 0.0, 0.0}, 0.01}};
  const TriMesh cube = MakeRoundedBox({0.05, 0.05, 0.05}, 0.0);
  hand.visuals.resize(2);
  hand.visuals[0].link = 0;
  hand.visuals[1].link = 2;
  hand.visuals[0].mesh = hand.visuals[1].mesh = cube;
  const std::vector<LinkProtrusion> protrusions = CalcContactProtrusions(hand);
  ASSERT_EQ(protrusions.size(), 1u);
  EXPECT_EQ(protrusions[0].link, "palm");
  EXPECT_NEAR(protrusions[0].protrusion, 0.005, 1e-7);
}

}  // namespace
}  // namespace graspbench
