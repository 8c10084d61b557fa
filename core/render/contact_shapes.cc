#include "core/render/contact_shapes.h"

#include <algorithm>
#include <memory>

#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

const Vector3f kBallColour(0.75f, 0.42f, 0.10f), kPadColour(0.06f, 0.25f, 0.60f),
    kCapsuleColour(0.45f, 0.47f, 0.50f);
constexpr double kThinner = 0.95;
constexpr int kBallSegments = 24;

void Append(const TriMesh& part, const Vector3d& place, TriMesh& mesh) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (const Vector3d& p : part.vertices) mesh.vertices.push_back(place + p);
  for (const Eigen::Vector3i& triangle : part.triangles) {
    mesh.triangles.push_back(triangle + Eigen::Vector3i::Constant(first));
  }
}

}  // namespace

void AddContactShapes(const Hand& hand, const Eigen::VectorXd& q, const Pose& X_WH, Scene* scene) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  for (size_t link = 0; link < hand.links.size(); ++link) {
    auto balls = std::make_shared<TriMesh>(), capsules = std::make_shared<TriMesh>();
    for (const ContactSphere& ball : hand.contact_spheres) {
      if (ball.link != static_cast<int>(link)) continue;
      Append(MakeSphere(ball.radius, kBallSegments), ball.p_LS, *balls);
    }
    for (const LinkCapsule& capsule : hand.capsules) {
      if (capsule.link != static_cast<int>(link)) continue;
      const double radius = kThinner * capsule.radius;
      Append(MakeTaperedCapsule(capsule.p_LA, radius, capsule.p_LB, radius), Vector3d::Zero(),
             *capsules);
    }
    const bool is_pad = std::any_of(
        hand.digits.begin(), hand.digits.end(),
        [&](const Digit& digit) { return digit.distal_link == static_cast<int>(link); });
    for (const auto& [mesh, colour] :
         {std::pair{balls, is_pad ? kPadColour : kBallColour}, {capsules, kCapsuleColour}}) {
      if (mesh->triangles.empty()) continue;
      Drawable drawable;
      drawable.mesh = mesh;
      drawable.X_WM = X_WH * X_HL[link];
      drawable.colour = colour;
      scene->drawables.push_back(drawable);
    }
  }
}

}  // namespace graspbench
