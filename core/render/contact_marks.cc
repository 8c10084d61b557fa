#include "core/render/contact_marks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/base/units.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kPointRadius = 0.0015;   // [m]
constexpr double kFailedRadius = 0.0040;  // [m]
constexpr double kShaftRadius = 0.0010;   // [m]
constexpr double kHeadRadius = 0.0026;    // [m]
constexpr double kHeadLength = 0.0070;    // [m]
constexpr double kConeLength = 0.018;     // [m]
constexpr double kWireRadius = 0.0004;    // [m]
constexpr double kAxisLength = 0.024;     // [m], half of it before the joint
constexpr int kNumSpokes = 10;
constexpr int kNumSegments = 8;  // around a wire

const Vector3f kForceColour(0.80f, 0.12f, 0.02f);
const Vector3f kPointColour(0.05f, 0.05f, 0.05f);
const Vector3f kFailedColour(0.85f, 0.0f, 0.60f);
const Vector3f kStaticColour(0.05f, 0.42f, 0.08f);
const Vector3f kDynamicColour(0.05f, 0.16f, 0.75f);

const Vector3f kBallColour(0.75f, 0.42f, 0.10f), kPadColour(0.06f, 0.25f, 0.60f),
    kCapsuleColour(0.45f, 0.47f, 0.50f);
constexpr double kThinner = 0.95;  // of a capsule
constexpr int kBallSegments = 24;

/** With its z axis along `axis`. */
Pose MakeAxisPose(const Vector3d& axis, const Vector3d& p_W) {
  return MakePose(Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis).toRotationMatrix(),
                  p_W);
}

void Append(const TriMesh& part, const Pose& X_MP, TriMesh& mesh) {
  const int first = mesh.num_vertices();
  for (const Vector3d& p_P : part.vertices) mesh.vertices.push_back(X_MP * p_P);
  for (const Eigen::Vector3i& triangle : part.triangles) {
    mesh.triangles.emplace_back(triangle.array() + first);
  }
}

/** The marks of one colour as one mesh: a picture has hundreds, and each mesh has its price. */
class MarkMesh {
 public:
  void Add(const TriMesh& mesh, const Pose& X_WM) { Append(mesh, X_WM, mesh_); }

  void MoveTo(Scene* scene, const Vector3f& colour) {
    if (mesh_.vertices.empty()) return;
    Drawable drawable;
    drawable.mesh = std::make_shared<const TriMesh>(std::move(mesh_));
    drawable.colour = colour;
    drawable.must_be_seen = false;
    drawable.is_mark = true;
    scene->drawables.push_back(std::move(drawable));
  }

 private:
  TriMesh mesh_;
};

/** Along z, with its tip at the origin. */
TriMesh MakeArrow(double length) {
  const double head = std::min(kHeadLength, 0.5 * length);
  const double scale = head / kHeadLength;
  return MakeRevolution({{0.0, -length},
                         {scale * kShaftRadius, -length},
                         {scale * kShaftRadius, -head},
                         {scale * kHeadRadius, -head},
                         {0.0, 0.0}},
                        16);
}

/** Around z, with its tip at the origin. */
void AddCone(double half_angle, const Pose& X_WM, MarkMesh* marks) {
  const double rim = kConeLength * std::sin(half_angle),
               height = kConeLength * std::cos(half_angle);
  std::vector<Vector3d> points;
  for (int i = 0; i < kNumSpokes; ++i) {
    const double angle = 2.0 * kPi * i / kNumSpokes;
    points.emplace_back(rim * std::cos(angle), rim * std::sin(angle), height);
  }
  for (size_t i = 0; i < points.size(); ++i) {
    const Vector3d& next = points[(i + 1) % points.size()];
    for (const auto& [from, to] :
         {std::pair(Vector3d(0.0, 0.0, 0.0), points[i]), std::pair(points[i], next)}) {
      marks->Add(MakeTaperedCapsule(from, kWireRadius, to, kWireRadius, kNumSegments), X_WM);
    }
  }
}

}  // namespace

void AddContactMarks(const std::vector<ContactMark>& contacts, double length_per_force,
                     Scene* scene) {
  MarkMesh points, failed, forces, still_cones, sliding_cones;
  for (const ContactMark& contact : contacts) {
    (contact.has_failed ? failed : points)
        .Add(MakeSphere(contact.has_failed ? kFailedRadius : kPointRadius, 16),
             MakePose(contact.p_WC));
    const double force = contact.force_W.norm();
    if (force > 0.0) {
      forces.Add(MakeArrow(length_per_force * force),
                 MakeAxisPose(contact.force_W / force, contact.p_WC));
    }
    if (contact.mu > 0.0) {
      AddCone(std::atan(contact.mu), MakeAxisPose(-contact.nhat_W, contact.p_WC),
              contact.is_sliding ? &sliding_cones : &still_cones);
    }
  }
  points.MoveTo(scene, kPointColour);
  failed.MoveTo(scene, kFailedColour);
  forces.MoveTo(scene, kForceColour);
  still_cones.MoveTo(scene, kStaticColour);
  sliding_cones.MoveTo(scene, kDynamicColour);
}

void AddContactShapes(const Hand& hand, const Eigen::VectorXd& q, const Pose& X_WH, Scene* scene) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  for (size_t link = 0; link < hand.links.size(); ++link) {
    auto balls = std::make_shared<TriMesh>(), capsules = std::make_shared<TriMesh>();
    for (const ContactSphere& ball : hand.contact_spheres) {
      if (ball.link != static_cast<int>(link)) continue;
      Append(MakeSphere(ball.radius, kBallSegments), MakePose(ball.p_LS), *balls);
    }
    for (const LinkCapsule& capsule : hand.capsules) {
      if (capsule.link != static_cast<int>(link)) continue;
      const double radius = kThinner * capsule.radius;
      Append(MakeTaperedCapsule(capsule.p_LA, radius, capsule.p_LB, radius), Pose::Identity(),
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

void AddJointAxes(const Hand& hand, const Eigen::VectorXd& q, const Pose& X_WH, Scene* scene) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  MarkMesh driven, coupled;
  for (const HandJoint& joint : hand.joints) {
    const size_t link = static_cast<size_t>(joint.link);
    const Pose X_WL = X_WH * X_HL[link];
    const Vector3d axis_W = X_WL.linear() * hand.links[link].axis;
    (joint.coupled_to < 0 ? driven : coupled)
        .Add(MakeArrow(kAxisLength),
             MakeAxisPose(axis_W, X_WL.translation() + 0.5 * kAxisLength * axis_W));
  }
  driven.MoveTo(scene, kForceColour);
  coupled.MoveTo(scene, kDynamicColour);
}

}  // namespace graspbench
