#include "datasets/gltf/glb_file.h"

#include <meshoptimizer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "core/base/error.h"
#include "core/render/display_mesh.h"
#include "core/shape/repair/mesh_topology.h"

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

constexpr size_t kAlignment = 4;  // of chunks and of vertices [bytes]
constexpr int kVertexBuffer = 34962, kIndexBuffer = 34963;

size_t CountComponents(std::string_view type) {
  return type == "SCALAR" ? 1 : static_cast<size_t>(type.back() - '0');
}

void AppendInteger(uint32_t value, size_t num_bytes, std::string& bytes) {
  for (size_t i = 0; i < num_bytes; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xff);
}

void AppendNumber(GltfComponent component, double value, std::string& bytes) {
  switch (component) {
    case GltfComponent::kByte:
      return AppendInteger(static_cast<uint32_t>(static_cast<int32_t>(value)), 1, bytes);
    case GltfComponent::kShort:
      return AppendInteger(static_cast<uint32_t>(static_cast<int32_t>(value)), 2, bytes);
    case GltfComponent::kUnsignedShort:
      return AppendInteger(static_cast<uint32_t>(value), 2, bytes);
    case GltfComponent::kUnsignedInt:
      return AppendInteger(static_cast<uint32_t>(value), 4, bytes);
    case GltfComponent::kFloat:
      const float single = static_cast<float>(value);
      uint32_t bits = 0;
      std::memcpy(&bits, &single, sizeof(bits));
      return AppendInteger(bits, 4, bytes);
  }
}

/** What a reader of the accessor finds. */
double CalcStored(GltfComponent component, double value) {
  return component == GltfComponent::kFloat ? static_cast<double>(static_cast<float>(value))
                                            : value;
}

void Align(char filling, std::string& bytes) {
  bytes.resize((bytes.size() + kAlignment - 1) / kAlignment * kAlignment, filling);
}

std::string MakeChunk(const char* type, const std::string& content) {
  std::string chunk;
  AppendInteger(static_cast<uint32_t>(content.size()), 4, chunk);
  return chunk.append(type, 4) + content;
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

int GlbFile::AddAccessor(const GltfNumbers& numbers, const std::vector<double>& values) {
  const size_t num_components = CountComponents(numbers.type);
  GRASPBENCH_DEMAND(!values.empty() && values.size() % num_components == 0,
                    std::to_string(values.size()));
  const size_t start = bytes_.size();
  for (size_t i = 0; i < values.size(); ++i) {
    GRASPBENCH_DEMAND(std::isfinite(values[i]), numbers.type);
    AppendNumber(numbers.component, values[i], bytes_);
    const bool ends_element = (i + 1) % num_components == 0;
    if (numbers.is_vertex_data && ends_element) Align('\0', bytes_);
  }
  const size_t num_elements = values.size() / num_components;
  Json view = {{"buffer", 0}, {"byteOffset", start}, {"byteLength", bytes_.size() - start}};
  if (numbers.is_vertex_data) {
    view["byteStride"] = (bytes_.size() - start) / num_elements;
    view["target"] = kVertexBuffer;
  } else if (numbers.is_index_data) {
    view["target"] = kIndexBuffer;
  }
  Align('\0', bytes_);

  Json accessor = {{"bufferView", views_.size()},
                   {"componentType", static_cast<int>(numbers.component)},
                   {"count", num_elements},
                   {"type", numbers.type}};
  if (numbers.is_normalised) accessor["normalized"] = true;
  for (size_t c = 0; numbers.has_range && c < num_components; ++c) {
    double low = values[c], high = values[c];
    for (size_t i = c; i < values.size(); i += num_components) {
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
    }
    accessor["min"].push_back(CalcStored(numbers.component, low));
    accessor["max"].push_back(CalcStored(numbers.component, high));
  }
  views_.push_back(std::move(view));
  accessors_.push_back(std::move(accessor));
  return static_cast<int>(accessors_.size()) - 1;
}

std::string GlbFile::Finish() {
  Json json = {{"asset", {{"version", "2.0"}, {"generator", "graspbench"}}}};
  json.update(root);
  if (!bytes_.empty()) {
    json["buffers"] = Json::array({Json{{"byteLength", bytes_.size()}}});
    json["bufferViews"] = views_;
    json["accessors"] = accessors_;
  }
  std::string text = FormatJson(json);
  Align(' ', text);
  std::string chunks = MakeChunk("JSON", text);
  if (!bytes_.empty()) chunks += MakeChunk("BIN\0", bytes_);
  std::string glb = "glTF";
  AppendInteger(2, 4, glb);
  AppendInteger(static_cast<uint32_t>(4 + 4 + 4 + chunks.size()), 4, glb);
  return glb + chunks;
}

}  // namespace graspbench
