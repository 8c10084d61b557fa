#pragma once
/** @file
The connected parts of a mesh, and what lies inside what. */

#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Triangles that share an edge are of one shell; at an edge of more than two, those that need each
other: what is whole without the others there only touches them. Numbers from 0 in the order of the
triangles. */
struct Shells {
  std::vector<int> of_triangle;
  int count = 0;
};
Shells FindShells(const TriMesh& mesh);

/** More shells are a soup of triangles, not parts, solids and cavities. */
constexpr int kMaxShells = 1024;

/** The triangles of each shell, with the vertices that they use. */
std::vector<TriMesh> SplitShells(const TriMesh& mesh, const Shells& shells);

/** How often the surface winds around p: 0 outside, 1 inside, -1 inside when it is inside out (Van
Oosterom, Strackee 1983). @pre closed; p does not lie on it. */
int CalcWinding(const TriMesh& mesh, const Eigen::Vector3d& p);

/** Some ten points all over a surface, none of them a corner: two surfaces often share those. */
std::vector<Eigen::Vector3d> SampleSurface(const TriMesh& mesh);

}  // namespace graspbench
