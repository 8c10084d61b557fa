#include "core/hand/import/mjcf/mjcf_meshes.h"

#include <Eigen/Geometry>
#include <filesystem>

#include "core/base/text/text.h"
#include "core/shape/convex_hull.h"

namespace graspbench {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void MjcfMeshes::Read(tinyxml2::XMLElement& element) {
  const MjcfNode node = document_.Resolve(element, nullptr);
  const char* own = element.Attribute("name");
  const char* address = document_.Find(node, "file");
  std::filesystem::path file = address ? address : "";
  const std::string name = own ? own : file.stem().string();
  const std::string where = "mesh \"" + name + "\"";
  Mesh mesh;
  if (!address || !*address) {
    mesh.solid = ReadInline(node, where);
    if (!mesh.solid) return;
  }
  if (document_.settings().strips_paths) file = file.filename();
  mesh.address =
      (std::filesystem::path(document_.settings().mesh_folder) / file).lexically_normal().string();
  mesh.scale = document_.FindVector(node, "scale", Vector3d::Ones(), where);
  if (mesh.scale.cwiseAbs().minCoeff() < 1e-9) {
    document_.Warn(element, where + ": a scale of zero; taken as 1");
    mesh.scale.setOnes();
  }
  // A vertex v is at scale * refquat^-1 (v - refpos).
  const Vector3d p = document_.FindVector(node, "refpos", Vector3d::Zero(), where);
  Matrix3d R = Matrix3d::Identity();
  if (const auto q = document_.FindNumbers(node, "refquat", 4, 4, where)) {
    const Eigen::Quaterniond quaternion((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
    if (quaternion.norm() > 1e-10) R = quaternion.normalized().toRotationMatrix();
  }
  const bool is_uniform = (mesh.scale.array() == mesh.scale[0]).all();
  if (!is_uniform && !R.isIdentity(1e-9)) {
    document_.Warn(element, where + ": a scale by axis of a turned mesh; its refquat is left out");
    R.setIdentity();
  }
  mesh.X_GM = MakePose(R.transpose(), -mesh.scale.cwiseProduct(R.transpose() * p));
  meshes_.emplace(name, mesh);
}

/** Reads vertices given in the model, with faces or as the corners of their convex hull. */
std::shared_ptr<const TriMesh> MjcfMeshes::ReadInline(const MjcfNode& node,
                                                      const std::string& where) {
  const auto leave_out = [&](const std::string& why) {
    document_.Warn(*node.xml, where + " " + why + "; left out");
    return nullptr;
  };
  if (!document_.Find(node, "vertex")) {
    return leave_out(document_.Find(node, "builtin") ? "is built in (builtin), which is not read"
                                                     : "has no file and no vertices");
  }
  constexpr size_t kMostNumbers = 30000;
  const auto numbers = document_.FindNumbers(node, "vertex", 12, kMostNumbers, where);
  if (!numbers || numbers->size() % 3 != 0) return leave_out("has no 4 vertices of 3 numbers");
  const auto mesh = std::make_shared<TriMesh>();
  for (size_t i = 0; i < numbers->size(); i += 3) {
    mesh->vertices.emplace_back((*numbers)[i], (*numbers)[i + 1], (*numbers)[i + 2]);
  }
  if (const auto corners = document_.FindNumbers(node, "face", 3, kMostNumbers, where)) {
    for (size_t i = 0; i + 2 < corners->size(); i += 3) {
      const Vector3d triangle((*corners)[i], (*corners)[i + 1], (*corners)[i + 2]);
      if (triangle.minCoeff() < 0.0 || triangle.maxCoeff() >= mesh->num_vertices()) {
        return leave_out("has a face of vertices that it lacks");
      }
      mesh->triangles.push_back(triangle.cast<int>());
    }
  } else {
    *mesh = MakeConvexHull(mesh->vertices);
  }
  if (mesh->triangles.empty()) return leave_out("has vertices that enclose nothing");
  return mesh;
}

bool MjcfMeshes::Place(const MjcfNode& node, const std::string& where, ForeignShape& shape) const {
  const char* name = document_.Find(node, "mesh");
  const auto mesh = meshes_.find(name ? name : "");
  if (mesh == meshes_.end()) {
    std::vector<std::string> known;
    for (const auto& [known_name, unused] : meshes_) known.push_back(known_name);
    document_.Warn(*node.xml, where + ": no mesh \"" + std::string(name ? name : "") +
                                  "\" that is read" + SuggestNames(name ? name : "", known));
    if (!name) return false;
    shape.kind = ForeignShape::Kind::kMesh;
    shape.mesh = name;  // no file: an error if the hand touches with it
    return true;
  }
  shape.kind = ForeignShape::Kind::kMesh;
  shape.mesh = mesh->second.solid ? mesh->first : mesh->second.address;
  shape.inline_mesh = mesh->second.solid;
  shape.scale = mesh->second.scale;
  shape.X_LS = shape.X_LS * mesh->second.X_GM;
  return true;
}

}  // namespace graspbench
