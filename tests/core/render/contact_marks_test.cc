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

TEST(ContactMarks, WithoutForceAndFrictionAPointIsLeft) {
  Scene scene;
  ContactMark contact = MakeContact();
  contact.force_W.setZero();
  contact.mu = 0.0;
  AddContactMarks({contact}, 0.01, &scene);
  EXPECT_EQ(scene.drawables.size(), 1u);
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

}  // namespace
}  // namespace graspbench
