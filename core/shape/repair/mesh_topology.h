#pragma once
/** @file
Connected parts of a mesh and their nesting. */

#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Shells of a mesh. Triangles that share an edge belong to one shell. At an edge of more than two
triangles, only sets that are unbalanced there are joined; a set that is balanced by itself merely
touches the others. Shells are numbered from 0 in the order of the triangles. */
struct Shells {
  std::vector<int> of_triangle;
  int count = 0;
};
Shells FindShells(const TriMesh& mesh);

/** A mesh with more shells is treated as a triangle soup, not as parts, solids and cavities. */
constexpr int kMaxShells = 1024;

/** Returns the triangles of each shell, with the vertices that they use. */
std::vector<TriMesh> SplitShells(const TriMesh& mesh, const Shells& shells);

/** Returns the winding number of the surface around p: 0 outside, 1 inside, -1 inside a mesh that
is inside out (Van Oosterom, Strackee 1983). @pre closed mesh; p is not on the surface. */
int CalcWinding(const TriMesh& mesh, const Eigen::Vector3d& p);

/** Returns about ten points distributed over a surface, none at a corner, because two surfaces
often share corners. */
std::vector<Eigen::Vector3d> SampleSurface(const TriMesh& mesh);

/** Some bodies of a mesh. Parts that touch or intersect each other form one body, and a cavity
belongs to the body around it. A simulated rigid object must be one body; otherwise a crumb that
floats beside a can would be lifted with it. */
struct BodyCount {
  int count = 0;
  double volume = 0.0;                              ///< [m^3]
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< a vertex of the first one [m]
};
struct Bodies {
  BodyCount apart;   ///< outside all others, without the largest body
  BodyCount nested;  ///< entirely inside others and facing outwards: this space is counted twice
};

/** Finds the bodies of a mesh. The result is exact if parts are closed and their surfaces are
farther apart than `gap`.
@param gap  parts closer than this touch [m].  @pre every shell is closed; finite vertices. */
Bodies FindBodies(const TriMesh& mesh, const Shells& shells, double gap);

/** An edge of a mesh, from its lower to its higher vertex, with the number of triangles along it in
each direction. */
struct MeshEdge {
  int from = -1;
  int to = -1;
  int num_forward = 0;      ///< triangles that traverse it from -> to
  int num_backward = 0;     ///< triangles that traverse it to -> from
  int first_triangle = -1;  ///< one of them
  int last_triangle = -1;   ///< another one, if there are several
};

/** A triangle counts as degenerate if the ratio of its height to its longest edge is below this. */
inline constexpr double kMinAspect = 1e-7;

/** Lists the edges, ordered by (from, to). In a closed, consistent mesh both counts are 1
everywhere. */
std::vector<MeshEdge> ListEdges(const TriMesh& mesh);

/** Returns whether every edge has as many triangles in one direction as in the other. */
bool IsWhole(const std::vector<MeshEdge>& edges);

/** Relative tolerance for merging coincident vertices, as a share of a mesh's largest coordinate or
extent: the distance of two copies of one corner in a file. Single precision has seven digits. */
inline constexpr double kRelativeWeldTolerance = 1e-6;

/** Merges each vertex into an earlier one within `tolerance` [m], so that neighbouring triangles
share vertices. Drops triangles that lose a corner and vertices that no triangle uses. Keeps the
order.
@param may_join  by vertex; vertices that may not be merged stay as they are. Empty: all may be.
@pre finite vertices, valid indices, tolerance > 0. */
TriMesh WeldVertices(const TriMesh& mesh, double tolerance, const std::vector<bool>& may_join = {});

}  // namespace graspbench
