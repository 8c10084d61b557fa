#pragma once
/** @file
A binary glTF 2.0 file (GLB) in the making: one JSON chunk and one buffer; and triangle meshes in
it.

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

/** Numbers of one accessor. */
struct GltfNumbers {
  GltfComponent component = GltfComponent::kFloat;
  const char* type = "SCALAR";  ///< "VEC3", "VEC4"
  bool is_normalised = false;   ///< integers stand for -1 .. 1
  bool has_range = false;       ///< the accessor says its smallest and largest values
  bool is_vertex_data = false;  ///< each vertex starts at a multiple of four bytes
  bool is_index_data = false;   ///< of triangles
};

class GlbFile {
 public:
  /** The glTF object; whoever makes the file adds nodes, meshes, animations. asset, buffers,
  bufferViews and accessors are written by Finish. */
  Json root = Json::object();

  /** @param values  element after element; integers must fit. @returns the accessor's index.
  @pre whole elements, at least one; finite. */
  int AddAccessor(const GltfNumbers& numbers, const std::vector<double>& values);

  /** The file's bytes. */
  std::string Finish();

 private:
  Json accessors_ = Json::array();
  Json views_ = Json::array();
  std::string bytes_;  // of the buffer, little endian
};

/** A triangle mesh in few bytes: coarse enough to be looked at, vertices as integers
(KHR_mesh_quantization): positions in 16 bits over the mesh's largest side, normals in 8.

A vertex lies within half of 1/65534 of that side of where it was, about 2 um on a hand.

Adds accessors, material and mesh of a colour to the file.
@param share  of the triangles that are wanted, at least some 64; 1 or more: all.
@returns a node without name that holds the mesh where it was; null when nothing of it is left. */
Json AddGltfMesh(const TriMesh& mesh, const Eigen::Vector3f& colour, double share, GlbFile& file);

}  // namespace graspbench
