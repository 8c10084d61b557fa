#pragma once
/** @file
A triangle mesh made ready for drawing: corners with smooth normals, sharp edges kept sharp. */

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
  bool is_closed = false;  ///< around a volume, facing outwards: its back faces are never seen
};

/** At each corner the normal is the mean of the faces around that point whose own normal is within
`crease_angle` [rad] of the corner's face, weighted by their angle at the point (Thuermer and
Wuethrich 1998). Vertices at the same place count as one, so a seam in the file does not show.
Triangles without area are left out. */
DisplayMesh MakeDisplayMesh(const TriMesh& mesh, double crease_angle);

/** The mesh with its vertices joined over a distance, of a row of powers of sqrt 2, that leaves at
most `max_triangles`; as it is when it has no more. What is left of a very small number may
be nothing. @pre finite vertices */
TriMesh MakeCoarseMesh(const TriMesh& mesh, int max_triangles);

}  // namespace graspbench
