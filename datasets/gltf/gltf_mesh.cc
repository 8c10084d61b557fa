#include "datasets/gltf/gltf_mesh.h"

#include <meshoptimizer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/render/display_mesh.h"
#include "core/shape/repair/weld_vertices.h"

namespace graspbench {
namespace {

constexpr int kFewTriangles = 64;     // less would not show what it is
constexpr double kCreaseAngle = 1.0;  // coarse meshes are smooth where fine ones were [rad]
constexpr double kLargestShort = 32767.0, kLargestByte = 127.0;
constexpr size_t kShortIndices = 65535;  // the largest one has a meaning of its own
constexpr const char* kQuantisation = "KHR_mesh_quantization";

/** With at most some `wanted` triangles, by edges that are taken out where they matter least
(Garland and Heckbert 1997, as in meshoptimizer). */
TriMesh SimplifyMesh(const TriMesh& original, int wanted) {
  constexpr double kSamePlace = 1e-7;  // [m]
  constexpr float kAnyError = 1.0f;    // of the mesh's extent: the number alone decides
  if (original.num_triangles() <= wanted) return original;
  TriMesh mesh = WeldVertices(original, kSamePlace);
  std::vector<Eigen::Vector3f> points;
  for (const Eigen::Vector3d& vertex : mesh.vertices) points.push_back(vertex.cast<float>());
  std::vector<unsigned> indices, kept(3 * mesh.triangles.size());
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (int corner : triangle) indices.push_back(static_cast<unsigned>(corner));
  }
  if (indices.empty()) return mesh;
  kept.resize(meshopt_simplify(kept.data(), indices.data(), indices.size(), points[0].data(),
                               points.size(), sizeof(points[0]), 3 * static_cast<size_t>(wanted),
                               kAnyError, 0, nullptr));
  mesh.triangles.clear();
  for (size_t i = 0; i + 2 < kept.size(); i += 3) {
    mesh.triangles.push_back(
        Eigen::Matrix<unsigned, 3, 1>(kept[i], kept[i + 1], kept[i + 2]).cast<int>());
  }
  return mesh;
}

/** Vertices and indices of the triangles that have an area after rounding: no reader divides by
one that has none. */
struct Quantised {
  std::vector<double> positions, normals, indices;
};

Quantised Quantise(const DisplayMesh& display, const Eigen::Vector3d& centre, double unit) {
  std::vector<Eigen::Vector3d> points;
  for (const DisplayVertex& vertex : display.vertices) {
    points.push_back(((vertex.position.cast<double>() - centre) / unit).array().round().matrix());
  }
  Quantised quantised;
  std::vector<double> new_index(points.size(), -1.0);
  for (size_t t = 0; t + 2 < display.indices.size(); t += 3) {
    const uint32_t* corner = &display.indices[t];
    const Eigen::Vector3d area =
        (points[corner[1]] - points[corner[0]]).cross(points[corner[2]] - points[corner[0]]);
    if (area.isZero(0.0)) continue;
    for (int i = 0; i < 3; ++i) {
      double& index = new_index[corner[i]];
      if (index < 0.0) {
        index = static_cast<double>(quantised.positions.size() / 3);
        const Eigen::Vector3d normal = display.vertices[corner[i]].normal.cast<double>();
        for (int axis = 0; axis < 3; ++axis) {
          quantised.positions.push_back(points[corner[i]][axis]);
          quantised.normals.push_back(std::round(kLargestByte * normal[axis]));
        }
      }
      quantised.indices.push_back(index);
    }
  }
  return quantised;
}

int FindOrAddMaterial(const Eigen::Vector3f& colour, GlbFile& file) {
  Json factors = Json::array();
  for (float part : colour) factors.push_back(std::round(1e4 * static_cast<double>(part)) / 1e4);
  factors.push_back(1.0);
  const Json material = {
      {"pbrMetallicRoughness",
       {{"baseColorFactor", factors}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.6}}}};
  Json& materials = file.root["materials"];
  const auto found = std::find(materials.begin(), materials.end(), material);
  const auto index = static_cast<int>(std::distance(materials.begin(), found));
  if (found == materials.end()) materials.push_back(material);
  return index;
}

}  // namespace

Json AddGltfMesh(const TriMesh& mesh, const Eigen::Vector3f& colour, double share, GlbFile& file) {
  const int wanted =
      std::max(kFewTriangles, static_cast<int>(std::min(share, 1.0) * mesh.num_triangles()));
  const DisplayMesh display = MakeDisplayMesh(SimplifyMesh(mesh, wanted), kCreaseAngle);
  Eigen::AlignedBox3d box;
  for (const DisplayVertex& vertex : display.vertices) box.extend(vertex.position.cast<double>());
  if (box.isEmpty() || box.sizes().maxCoeff() <= 0.0) return {};
  const double unit = 0.5 * box.sizes().maxCoeff() / kLargestShort;
  const Quantised quantised = Quantise(display, box.center(), unit);
  if (quantised.indices.empty()) return {};

  const int positions =
      file.AddAccessor({GltfComponent::kShort, "VEC3", false, true, true}, quantised.positions);
  const int normals =
      file.AddAccessor({GltfComponent::kByte, "VEC3", true, false, true}, quantised.normals);
  const bool is_small = quantised.positions.size() / 3 < kShortIndices;
  const int indices =
      file.AddAccessor({is_small ? GltfComponent::kUnsignedShort : GltfComponent::kUnsignedInt,
                        "SCALAR", false, false, false, true},
                       quantised.indices);
  file.root["extensionsUsed"] = file.root["extensionsRequired"] = Json::array({kQuantisation});
  const Json primitive = {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                          {"indices", indices},
                          {"material", FindOrAddMaterial(colour, file)}};
  Json& meshes = file.root["meshes"];
  meshes.push_back(Json{{"primitives", Json::array({primitive})}});
  return {{"mesh", meshes.size() - 1},
          {"translation", JsonVector(box.center())},
          {"scale", {unit, unit, unit}}};
}

}  // namespace graspbench
