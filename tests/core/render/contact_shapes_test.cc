#include "core/render/contact_shapes.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

using Eigen::Vector3d;

// Two links, the second turned by a quarter about z; a ball on each, a capsule on the first.
Hand MakeHand() {
  Hand hand;
  hand.links.resize(2);
  hand.links[1].parent = 0;
  hand.links[1].joint = 0;
  hand.links[1].axis = Vector3d::UnitZ();
  hand.links[1].X_PJ = MakePose(Vector3d(0.0, 0.0, 0.1));
  hand.joints.resize(1);
  hand.joints[0].link = 1;
  hand.digits.resize(1);
  hand.digits[0].distal_link = 1;
  hand.contact_spheres = {{0, Vector3d(0.01, 0.0, 0.0), 0.02}, {1, Vector3d(0.05, 0.0, 0.0), 0.01}};
  hand.capsules = {{0, Vector3d::Zero(), Vector3d(0.0, 0.03, 0.0), 0.02}};
  return hand;
}

TEST(ContactShapesTest, BallsAreWhereAndAsLargeAsTheyTouch) {
  const Hand hand = MakeHand();
  const Pose X_WH = MakePose(Vector3d(1.0, 2.0, 3.0));
  Scene scene;
  AddContactShapes(hand, Eigen::VectorXd::Constant(1, M_PI / 2.0), X_WH, &scene);
  ASSERT_EQ(scene.drawables.size(), 3u);
  const std::pair<size_t, std::pair<Vector3d, double>> balls[] = {{0, {{1.01, 2.0, 3.0}, 0.02}},
                                                                  {2, {{1.0, 2.05, 3.1}, 0.01}}};
  for (const auto& [index, ball] : balls) {
    for (const Vector3d& p_M : scene.drawables[index].mesh->vertices) {
      const Vector3d p_W = scene.drawables[index].X_WM * p_M;
      EXPECT_NEAR((p_W - ball.first).norm(), ball.second, 1e-12);
    }
  }
  for (const Vector3d& p_M : scene.drawables[1].mesh->vertices) {
    const Vector3d p_L = scene.drawables[1].X_WM * p_M - X_WH.translation();
    const Vector3d nearest(0.0, std::clamp(p_L.y(), 0.0, 0.03), 0.0);
    EXPECT_NEAR((p_L - nearest).norm(), 0.95 * 0.02, 1e-6);
  }
  EXPECT_NE(scene.drawables[0].colour, scene.drawables[2].colour);  // a pad
}

}  // namespace
}  // namespace graspbench
