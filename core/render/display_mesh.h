#pragma once
/** @file
A triangle mesh prepared for drawing: corners with smooth normals, while sharp edges stay sharp. */

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

struct DisplayVertex {
  Eigen::Vector3f position;  ///< [m], in the mesh's frame
  Eigen::Vector3f normal;    ///< unit
};

struct DisplayMesh {
  std::vector<DisplayVertex> vertices;
  std::vector<uint32_t> indices;  ///< three per triangle
  bool is_closed = false;         ///< closed and facing outwards: back faces are never visible
};

/** Computes smooth normals. The normal at a corner is the mean over the faces around that point
whose normal is within `crease_angle` [rad] of that of the corner's face. Faces are weighted by
their angle at the point (Thuermer and Wuethrich 1998). Coincident vertices count as one, so a seam
in the file is invisible. Degenerate triangles are dropped. */
DisplayMesh MakeDisplayMesh(const TriMesh& mesh, double crease_angle);

/** Returns a mesh with at most `max_triangles` triangles by merging vertices within the smallest
sufficient distance of a sequence of powers of sqrt 2. A mesh that is small enough is returned
unchanged. A very small limit may leave no triangles. @pre finite vertices */
TriMesh MakeCoarseMesh(const TriMesh& mesh, int max_triangles);

}  // namespace graspbench
