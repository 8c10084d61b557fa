#pragma once
/** @file
Builds a binary glTF 2.0 file (GLB) with one JSON chunk and one buffer, and adds triangle meshes.

Source: Khronos, glTF 2.0 specification, sections 3.6 (binary data) and 4 (GLB). */

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

enum class GltfComponent {
  kByte = 5120,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126
};

/** Layout of the numbers of one accessor. */
struct GltfNumbers {
  GltfComponent component = GltfComponent::kFloat;
  const char* type = "SCALAR";  ///< "VEC3", "VEC4"
  bool is_normalised = false;   ///< integers represent -1 .. 1
  bool has_range = false;       ///< the accessor states its minimum and maximum
  bool is_vertex_data = false;  ///< vertices are aligned to four bytes
  bool is_index_data = false;   ///< indices of triangles
};

class GlbFile {
 public:
  /** The glTF object. The caller adds nodes, meshes and animations; Finish writes asset, buffers,
  bufferViews and accessors. */
  Json root = Json::object();

  /** @param values  element by element; integers must fit. @returns the accessor's index.
  @pre complete elements, at least one; finite values. */
  int AddAccessor(const GltfNumbers& numbers, const std::vector<double>& values);

  /** Returns the file's bytes. */
  std::string Finish();

 private:
  Json accessors_ = Json::array();
  Json views_ = Json::array();
  std::string bytes_;  // of the buffer, little endian
};

/** Adds accessors, material and mesh of a colour to the file. The mesh is simplified for display
and has integer vertices (KHR_mesh_quantization): 16 bits over the mesh's largest side for
positions, 8 bits for normals. A vertex moves by at most half of 1/65534 of that side, about 2 um on
a hand.
@param share  of the triangles to keep, at least some 64; 1 or more: all.
@returns a node without name that holds the mesh in its original place; null if nothing is left. */
Json AddGltfMesh(const TriMesh& mesh, const Eigen::Vector3f& colour, double share, GlbFile& file);

}  // namespace graspbench
