#pragma once
/** @file
Triangle mesh as plain data, in metres; triangles are counter-clockwise seen from outside. */

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/base/hash.h"

namespace graspbench {

struct TriMesh {
  std::vector<Eigen::Vector3d> vertices;  ///< [m], in the mesh's own frame
  std::vector<Eigen::Vector3i>
      triangles;  ///< indices into vertices; outward by the right-hand rule

  int num_vertices() const { return static_cast<int>(vertices.size()); }
  int num_triangles() const { return static_cast<int>(triangles.size()); }
};

/** Returns the bounding box of all vertices, used or not; empty without vertices. */
inline Eigen::AlignedBox3d CalcBounds(const TriMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  return box;
}

/** Returns the hash of all coordinates and indices, bit for bit. */
inline uint64_t CalcMeshHash(const TriMesh& mesh) {
  static_assert(sizeof(Eigen::Vector3d) == 24 && sizeof(Eigen::Vector3i) == 12);
  const std::string_view vertices(reinterpret_cast<const char*>(mesh.vertices.data()),
                                  mesh.vertices.size() * sizeof(Eigen::Vector3d));
  const std::string_view triangles(reinterpret_cast<const char*>(mesh.triangles.data()),
                                   mesh.triangles.size() * sizeof(Eigen::Vector3i));
  return CalcHash64(triangles, CalcHash64(vertices, mesh.vertices.size()));
}

}  // namespace graspbench
