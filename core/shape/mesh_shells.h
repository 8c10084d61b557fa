#pragma once
/** @file The connected parts of a mesh, and what lies inside what. */

#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Triangles that share an edge, however many others share it too, are of one shell. Numbers from 0
in the order of the triangles. */
struct Shells {
  std::vector<int> of_triangle;
  int count = 0;
};
Shells FindShells(const TriMesh& mesh);

/** More shells are a soup of triangles, not parts, solids and cavities. */
constexpr int kMaxShells = 64;

/** The triangles of each shell, with all vertices. */
std::vector<TriMesh> SplitShells(const TriMesh& mesh, const Shells& shells);

/** How often the surface winds around p: 0 outside, 1 inside, -1 inside when it is inside out (Van
Oosterom, Strackee 1983). @pre closed; p does not lie on it. */
int CalcWinding(const TriMesh& mesh, const Eigen::Vector3d& p);

}  // namespace graspbench
