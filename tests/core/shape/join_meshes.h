#pragma once
/** @file
Two meshes as one, for tests: neither is changed where they meet. */

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** @param offset  of `part`, from the origin [m]. */
inline TriMesh JoinMeshes(TriMesh mesh, const TriMesh& part,
                          const Eigen::Vector3d& offset = Eigen::Vector3d::Zero()) {
  const int first = mesh.num_vertices();
  for (const Eigen::Vector3d& p : part.vertices) mesh.vertices.push_back(p + offset);
  for (const Eigen::Vector3i& t : part.triangles) {
    mesh.triangles.push_back(t + Eigen::Vector3i::Constant(first));
  }
  return mesh;
}

}  // namespace graspbench
