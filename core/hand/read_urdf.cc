#include "core/hand/read_urdf.h"

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "core/base/files/files.h"
#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

constexpr double kLargestMesh = 2.0;  // [m] from its origin

/** While it lives, what urdfdom would print to the console becomes a problem of the file. The
console's handler is one for the whole program, so one at a time. */
class ConsoleCatcher : public console_bridge::OutputHandler {
 public:
  ConsoleCatcher(std::string file, Diagnostics& problems)
      : lock_(ConsoleMutex()), file_(std::move(file)), problems_(problems) {
    console_bridge::useOutputHandler(this);
  }
  ~ConsoleCatcher() override { console_bridge::restorePreviousOutputHandler(); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) problems_.Fail(file_, 0, text);
  }

 private:
  static std::mutex& ConsoleMutex() {
    static std::mutex mutex;
    return mutex;
  }

  std::lock_guard<std::mutex> lock_;
  std::string file_;
  Diagnostics& problems_;
};

Eigen::Vector3d VectorFrom(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Pose PoseFrom(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  return MakePose(Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix(),
                  VectorFrom(pose.position));
}

float LinearFromSrgb(float value) {
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

/** The solid around the origin of its frame; a mesh as it is in its file, scaled. */
TriMesh MakeVisualMesh(const urdf::Geometry& geometry, const std::filesystem::path& folder,
                       Diagnostics& problems) {
  switch (geometry.type) {
    case urdf::Geometry::SPHERE:
      return MakeSphere(static_cast<const urdf::Sphere&>(geometry).radius);
    case urdf::Geometry::BOX:
      return MakeRoundedBox(VectorFrom(static_cast<const urdf::Box&>(geometry).dim), 0.0);
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
      const double r = cylinder.radius, h = cylinder.length / 2.0;
      return MakeRevolution({{0.0, -h}, {r, -h}, {r, h}, {0.0, h}});
    }
    case urdf::Geometry::MESH:
      break;
  }
  const auto& file = static_cast<const urdf::Mesh&>(geometry);
  const std::filesystem::path path = folder / file.filename;
  TriMesh mesh = ParseObj(ReadFile(path), path.string(), problems);
  double extent = 0.0;
  for (Eigen::Vector3d& p : mesh.vertices) {
    p = p.cwiseProduct(VectorFrom(file.scale));
    extent = std::max(extent, p.cwiseAbs().maxCoeff());
  }
  if (!(extent <= kLargestMesh)) {
    problems.Fail(path.string(), 0,
                  "the mesh reaches farther than 2 m; URDF is in metres, so one in millimetres "
                  "needs scale=\"0.001 0.001 0.001\"");
  }
  return mesh;
}

/** As AddContact has it (contact_shape.h), but for the edges of a box. */
TriMesh MakeShapeMesh(const CollisionShape& shape) {
  if (shape.kind == CollisionShape::Kind::kBox) return MakeRoundedBox(shape.size, 0.0);
  const double radius = 0.5 * shape.size.x();
  if (shape.kind == CollisionShape::Kind::kSphere) return MakeSphere(radius);
  const double half = 0.5 * shape.size.z();
  if (half < radius) {
    return MakeRevolution({{0.0, -half}, {radius, -half}, {radius, half}, {0.0, half}});
  }
  const Eigen::Vector3d end(0.0, 0.0, half - radius);
  return MakeTaperedCapsule(-end, radius, end, radius);
}

class UrdfReader {
 public:
  UrdfReader(std::filesystem::path folder, Hand& hand, Diagnostics& problems)
      : folder_(std::move(folder)), hand_(hand), problems_(problems) {}

  void AddLink(const urdf::Link& link, int parent) {
    const int index = static_cast<int>(hand_.links.size());
    HandLink& added = hand_.links.emplace_back();
    added.name = link.name;
    added.parent = parent;
    if (link.inertial) AddInertia(*link.inertial, added);
    if (parent >= 0) AddJoint(*link.parent_joint, index);
    for (const auto& collision : link.collision_array) AddCollision(*collision, index);
    for (const auto& visual : link.visual_array) AddVisual(*visual, index);
    for (const auto& child : link.child_links) AddLink(*child, index);
  }

  /** A hand without pictures looks like what it touches with. */
  void ShowShapes() {
    if (!hand_.visuals.empty()) return;
    for (const CollisionShape& shape : shapes_) {
      if (shape.is_cover) continue;
      LinkVisual& added = hand_.visuals.emplace_back();
      added.link = shape.link;
      added.mesh = MakeShapeMesh(shape);
      for (Eigen::Vector3d& p : added.mesh.vertices) p = shape.X_LS * p;
    }
  }

  std::vector<CollisionShape> TakeShapes() { return std::move(shapes_); }

 private:
  static void AddInertia(const urdf::Inertial& inertial, HandLink& link) {
    Eigen::Matrix3d I;
    I << inertial.ixx, inertial.ixy, inertial.ixz,  //
        inertial.ixy, inertial.iyy, inertial.iyz,   //
        inertial.ixz, inertial.iyz, inertial.izz;
    const Pose X_LI = PoseFrom(inertial.origin);
    link.mass = inertial.mass;
    link.p_LLcm = X_LI.translation();
    link.I_LLcm = X_LI.linear() * I * X_LI.linear().transpose();
  }

  void AddJoint(const urdf::Joint& joint, int link) {
    HandLink& moved = hand_.links[link];
    moved.X_PJ = PoseFrom(joint.parent_to_joint_origin_transform);
    const bool is_prismatic = joint.type == urdf::Joint::PRISMATIC;
    if (joint.type != urdf::Joint::REVOLUTE && !is_prismatic) return;
    moved.axis = VectorFrom(joint.axis).normalized();
    moved.joint = hand_.num_joints();
    HandJoint& added = hand_.joints.emplace_back();
    added.name = joint.name;
    added.link = link;
    added.is_prismatic = is_prismatic;
    added.lower = joint.limits->lower;
    added.upper = joint.limits->upper;
  }

  void AddCollision(const urdf::Collision& collision, int link) {
    CollisionShape& shape = shapes_.emplace_back();
    shape.link = link;
    shape.X_LS = PoseFrom(collision.origin);
    shape.is_cover = collision.name == "cover";
    if (collision.geometry->type == urdf::Geometry::SPHERE) {
      shape.kind = CollisionShape::Kind::kSphere;
      shape.size.setConstant(2.0 * static_cast<const urdf::Sphere&>(*collision.geometry).radius);
    } else if (collision.geometry->type == urdf::Geometry::CYLINDER) {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(*collision.geometry);
      shape.kind = CollisionShape::Kind::kCylinder;
      shape.size = {2.0 * cylinder.radius, 2.0 * cylinder.radius, cylinder.length};
    } else {
      shape.kind = CollisionShape::Kind::kBox;
      shape.size = VectorFrom(static_cast<const urdf::Box&>(*collision.geometry).dim);
    }
  }

  void AddVisual(const urdf::Visual& visual, int link) {
    LinkVisual& added = hand_.visuals.emplace_back();
    added.link = link;
    added.mesh = MakeVisualMesh(*visual.geometry, folder_, problems_);
    const Pose X_LV = PoseFrom(visual.origin);
    for (Eigen::Vector3d& p : added.mesh.vertices) p = X_LV * p;
    if (visual.material) {
      const urdf::Color& colour = visual.material->color;
      added.colour = {LinearFromSrgb(colour.r), LinearFromSrgb(colour.g), LinearFromSrgb(colour.b)};
    }
  }

  std::filesystem::path folder_;
  Hand& hand_;
  Diagnostics& problems_;
  std::vector<CollisionShape> shapes_;
};

}  // namespace

std::vector<CollisionShape> ReadUrdf(const std::string& document, const std::string& file,
                                     const std::filesystem::path& folder, Hand& hand,
                                     Diagnostics& problems) {
  ConsoleCatcher catcher(file, problems);
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(document);
  if (!model || !model->getRoot()) {
    problems.Fail(file, 0, "urdfdom cannot read this hand");
    return {};
  }
  UrdfReader reader(folder, hand, problems);
  reader.AddLink(*model->getRoot(), -1);
  reader.ShowShapes();
  return reader.TakeShapes();
}

}  // namespace graspbench
