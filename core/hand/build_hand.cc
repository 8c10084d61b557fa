#include "core/hand/build_hand.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/files/files.h"
#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

constexpr double kLargestMesh = 2.0;  // [m] from its origin

float LinearFromSrgb(float value) {
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

/** A mesh as it is in its file, scaled. */
TriMesh LoadMesh(const UrdfShape& visual, const std::filesystem::path& folder,
                 Diagnostics& problems) {
  const std::filesystem::path path = folder / visual.mesh;
  TriMesh mesh = ParseObj(ReadFile(path), path.string(), problems);
  double extent = 0.0;
  for (Eigen::Vector3d& p : mesh.vertices) {
    p = p.cwiseProduct(visual.scale);
    extent = std::max(extent, p.cwiseAbs().maxCoeff());
  }
  if (!(extent <= kLargestMesh)) {
    problems.Fail(path.string(), 0,
                  "the mesh reaches farther than 2 m; URDF is in metres, so one in millimetres "
                  "needs scale=\"0.001 0.001 0.001\"");
  }
  return mesh;
}

/** The solid around the origin of its frame. @param is_contact  as AddContact has it
(contact_shape.h), but for the edges of a box. */
TriMesh MakeSolid(const UrdfShape& shape, bool is_contact) {
  if (shape.kind == UrdfShape::Kind::kBox) return MakeRoundedBox(shape.size, 0.0);
  const double radius = 0.5 * shape.size.x();
  if (shape.kind == UrdfShape::Kind::kSphere) return MakeSphere(radius);
  const double half = 0.5 * shape.size.z();
  if (!is_contact || half < radius) {
    return MakeRevolution({{0.0, -half}, {radius, -half}, {radius, half}, {0.0, half}});
  }
  const Eigen::Vector3d end(0.0, 0.0, half - radius);
  return MakeTaperedCapsule(-end, radius, end, radius);
}

class HandBuilder {
 public:
  HandBuilder(const Urdf& urdf, std::filesystem::path folder, Hand& hand, Diagnostics& problems)
      : urdf_(urdf), folder_(std::move(folder)), hand_(hand), problems_(problems) {
    for (const UrdfJoint& joint : urdf.joints) below_[joint.parent][joint.name] = &joint;
    has_visuals_ = std::any_of(urdf.links.begin(), urdf.links.end(),
                               [](const UrdfLink& link) { return !link.visuals.empty(); });
  }

  std::vector<CollisionShape> Build() {
    std::vector<bool> is_child(urdf_.links.size(), false);
    for (const UrdfJoint& joint : urdf_.joints) is_child[joint.child] = true;
    const auto root = std::find(is_child.begin(), is_child.end(), false) - is_child.begin();
    AddLink(static_cast<int>(root), nullptr, -1);
    return std::move(shapes_);
  }

 private:
  void AddLink(int urdf_index, const UrdfJoint* joint, int parent) {
    const UrdfLink& link = urdf_.links[urdf_index];
    const int index = static_cast<int>(hand_.links.size());
    HandLink& added = hand_.links.emplace_back();
    added.name = link.name;
    added.parent = parent;
    if (link.inertia) {
      const UrdfInertia& inertia = *link.inertia;
      added.mass = inertia.mass;
      added.p_LLcm = inertia.X_LI.translation();
      added.I_LLcm = inertia.X_LI.linear() * inertia.I_I * inertia.X_LI.linear().transpose();
    }
    if (joint) AddJoint(*joint, index);
    for (const UrdfShape& collision : link.collisions) {
      AddCollision(collision, index);
      if (!has_visuals_ && !shapes_.back().is_cover) AddVisual(collision, true, index);
    }
    for (const UrdfShape& visual : link.visuals) AddVisual(visual, false, index);
    for (const auto& [name, next] : below_[urdf_index]) AddLink(next->child, next, index);
  }

  void AddJoint(const UrdfJoint& joint, int link) {
    HandLink& moved = hand_.links[link];
    moved.X_PJ = joint.X_PJ;
    if (joint.kind == UrdfJoint::Kind::kFixed) return;
    moved.axis = joint.axis;
    moved.joint = hand_.num_joints();
    HandJoint& added = hand_.joints.emplace_back();
    added.name = joint.name;
    added.link = link;
    added.is_prismatic = joint.kind == UrdfJoint::Kind::kPrismatic;
    added.lower = joint.limit->lower;
    added.upper = joint.limit->upper;
  }

  void AddCollision(const UrdfShape& collision, int link) {
    CollisionShape& shape = shapes_.emplace_back();
    shape.link = link;
    shape.X_LS = collision.X_LS;
    shape.size = collision.size;
    shape.is_cover = collision.name == "cover";
    shape.kind = collision.kind == UrdfShape::Kind::kSphere     ? CollisionShape::Kind::kSphere
                 : collision.kind == UrdfShape::Kind::kCylinder ? CollisionShape::Kind::kCylinder
                                                                : CollisionShape::Kind::kBox;
  }

  void AddVisual(const UrdfShape& shape, bool is_contact, int link) {
    LinkVisual& added = hand_.visuals.emplace_back();
    added.link = link;
    added.mesh = shape.kind == UrdfShape::Kind::kMesh ? LoadMesh(shape, folder_, problems_)
                                                      : MakeSolid(shape, is_contact);
    for (Eigen::Vector3d& p : added.mesh.vertices) p = shape.X_LS * p;
    if (is_contact || !shape.colour) return;
    for (int i = 0; i < 3; ++i) {
      added.colour[i] = LinearFromSrgb(static_cast<float>((*shape.colour)[i]));
    }
  }

  const Urdf& urdf_;
  std::filesystem::path folder_;
  Hand& hand_;
  Diagnostics& problems_;
  std::map<int, std::map<std::string, const UrdfJoint*>> below_;  // joints by parent and name
  bool has_visuals_ = false;
  std::vector<CollisionShape> shapes_;
};

}  // namespace

std::vector<CollisionShape> BuildHand(const Urdf& urdf, const std::filesystem::path& folder,
                                      Hand& hand, Diagnostics& problems) {
  return HandBuilder(urdf, folder, hand, problems).Build();
}

}  // namespace graspbench
