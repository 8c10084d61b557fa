#pragma once
/** @file
Triangle mesh as plain data, in metres, counter-clockwise seen from outside. */

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace graspbench {

struct TriMesh {
  std::vector<Eigen::Vector3d> vertices;  ///< [m], in the mesh's own frame
  std::vector<Eigen::Vector3i>
      triangles;  ///< indices into vertices; outward by the right-hand rule

  int num_vertices() const { return static_cast<int>(vertices.size()); }
  int num_triangles() const { return static_cast<int>(triangles.size()); }
};

/** Of all vertices, used or not; empty without any. */
inline Eigen::AlignedBox3d CalcBounds(const TriMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  return box;
}

}  // namespace graspbench
