#include "core/render/contact_marks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

ContactMark MakeContact() {
  ContactMark contact;
  contact.p_WC = Vector3d(0.1, -0.2, 0.3);
  contact.nhat_W = Vector3d(1.0, 2.0, -2.0) / 3.0;
  contact.force_W = Vector3d(3.0, 0.0, -4.0);
  contact.mu = 0.5;
  return contact;
}

/** All vertices of the marks of one colour channel, in the world. */
std::vector<Vector3d> FindPoints(const Scene& scene, int channel) {
  std::vector<Vector3d> points;
  for (const Drawable& drawable : scene.drawables) {
    Eigen::Index largest = 0;
    if (drawable.colour.maxCoeff(&largest) < 0.1f || largest != channel) continue;
    for (const Vector3d& p_M : drawable.mesh->vertices) points.push_back(drawable.X_WM * p_M);
  }
  return points;
}

TEST(ContactMarks, TheArrowEndsAtTheContactAndIsAsLongAsTheForce) {
  Scene scene;
  const ContactMark contact = MakeContact();
  AddContactMarks({contact}, 0.01, &scene);
  const Vector3d along = contact.force_W.normalized();
  double first = 1.0, last = -1.0;
  for (const Vector3d& p_W : FindPoints(scene, 0)) {  // red
    const Vector3d p_CP = p_W - contact.p_WC;
    first = std::min(first, along.dot(p_CP));
    last = std::max(last, along.dot(p_CP));
    EXPECT_LT((p_CP - along.dot(p_CP) * along).norm(), 0.003);
  }
  EXPECT_NEAR(last, 0.0, 1e-12);
  EXPECT_NEAR(first, -0.05, 1e-12);  // 5 N
}

// A force at the edge of the cone lies on it: the wires are at the angle atan(mu) from the normal,
// on the side that the force comes from.
TEST(ContactMarks, TheConeOpensByTheAngleOfFriction) {
  Scene scene;
  ContactMark contact = MakeContact();
  for (const bool is_sliding : {false, true}) {
    scene.drawables.clear();
    contact.is_sliding = is_sliding;
    AddContactMarks({contact}, 0.01, &scene);
    EXPECT_TRUE(FindPoints(scene, is_sliding ? 1 : 2).empty());
    const std::vector<Vector3d> points = FindPoints(scene, is_sliding ? 2 : 1);
    ASSERT_GT(points.size(), 100u);
    double widest = 0.0;
    for (const Vector3d& p_W : points) {
      const Vector3d p_CP = p_W - contact.p_WC;
      const double depth = -contact.nhat_W.dot(p_CP);
      EXPECT_GT(depth, -0.001);
      const double wide = (p_CP + depth * contact.nhat_W).norm();
      EXPECT_LT(wide, contact.mu * depth + 0.001) << "outside, by more than a wire";
      if (depth > 0.01) widest = std::max(widest, wide / depth);
    }
    EXPECT_NEAR(widest, contact.mu, 0.06);
  }
}

// What is inside a ball is seen all the same, and throws no shadow.
TEST(ContactMarks, NothingHidesThem) {
  Scene scene;
  Drawable ball;
  ball.mesh = std::make_shared<const TriMesh>(MakeSphere(0.05));
  ball.X_WM = MakePose(Vector3d(0.0, 0.0, 0.05));
  scene.drawables = {ball};
  Camera camera;
  camera.p_WTarget = Vector3d(0.0, 0.0, 0.05);
  camera.p_WEye = Vector3d(0.1, -0.1, 0.1);
  Renderer renderer(96, 72);
  const Image without = renderer.Render(scene, camera);
  ContactMark contact;
  contact.p_WC = camera.p_WTarget;
  contact.force_W = Vector3d(0.0, 0.0, 1.0);
  AddContactMarks({contact}, 0.03, &scene);
  const Image with = renderer.Render(scene, camera);
  int num_red = 0, num_other = 0;
  for (size_t i = 0; i < with.rgb.size(); i += 3) {
    if (std::equal(&with.rgb[i], &with.rgb[i] + 3, &without.rgb[i])) continue;
    (with.rgb[i] > 1.5 * with.rgb[i + 1] ? num_red : num_other) += 1;
  }
  EXPECT_GT(num_red, 15);
  EXPECT_LT(num_other, 4 * num_red) << "more than its own edges has changed";
}

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
