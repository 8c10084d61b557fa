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

/** Which parts of a mesh are one body: those that touch or cross each other, and a cavity with what
surrounds it. A rigid object that is simulated must be one body; a crumb that floats beside a can
would be lifted with it.

Some bodies of a mesh. */
struct BodyCount {
  int count = 0;
  double volume = 0.0;                              ///< [m^3]
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< on the first one [m]
};
struct Bodies {
  BodyCount apart;   ///< outside of all others, but for the largest body
  BodyCount nested;  ///< altogether inside others and facing outwards: that space counts twice
};

/** @param gap  parts that are nearer to each other touch [m]. Off by nothing where parts are closed
and their surfaces farther apart than that. @pre every shell is closed; finite vertices. */
Bodies FindBodies(const TriMesh& mesh, const Shells& shells, double gap);

/** The edges of a mesh, how many triangles run along each in either direction, and which triangles
count as ones without area.

An edge from its lower to its higher vertex. */
struct MeshEdge {
  int from = -1;
  int to = -1;
  int num_forward = 0;      ///< triangles that run along it from -> to
  int num_backward = 0;     ///< triangles that run along it to -> from
  int first_triangle = -1;  ///< one of them
  int last_triangle = -1;   ///< another one, when there are more
};

/** A triangle whose height against its longest edge is smaller has no area. */
inline constexpr double kMinAspect = 1e-7;

/** Ordered by (from, to). In a closed, consistent mesh both counts are 1 everywhere. */
std::vector<MeshEdge> ListEdges(const TriMesh& mesh);

/** As many triangles in one direction as in the other at every edge? */
bool IsWhole(const std::vector<MeshEdge>& edges);

/** Joins coincident vertices, so that neighbouring triangles share them. Of a mesh's largest
coordinate or extent: what two vertices of one corner are apart when a file wrote it twice. Single
precision keeps seven digits. */
inline constexpr double kRelativeWeldTolerance = 1e-6;

/** Vertices within `tolerance` [m] of an earlier one become that one; triangles that lose a corner
and vertices that no triangle uses are dropped. The order of what remains is kept.
@param may_join  by vertex; those that may not stay as they are. Empty: all may.
@pre finite vertices, valid indices, tolerance > 0. */
TriMesh WeldVertices(const TriMesh& mesh, double tolerance, const std::vector<bool>& may_join = {});

}  // namespace graspbench
