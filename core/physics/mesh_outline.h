#pragma once
/** @file
Parts of a mesh that can touch a plane: the outermost vertices, and the circles that its rims
represent.

A can, a coin or a cone is round about one axis, but its mesh is a polygon there, and every edge
brakes a rolling rigid polygon. At each edge of 48, a solid cylinder keeps (1/2 + cos a) / (3/2) of
its speed, with a = 7.5 degrees. So rings of equal sides that turn by less than 19 degrees each and
cover most of a turn act as circles.

Ridges of a regular relief, such as the dimples of a golf ball, form rings about many axes; only
axes about which much of the outside is round count. Prisms of 17 to 23 sides are near that limit:
up to 18 sides they stay polygons, from 19 on they roll as circles. */

#include <Eigen/Core>
#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Finds the outermost vertex in each of many directions, v(d) = argmax d . v; the first of equal
ones.

Consecutive vertices of a mesh are close to each other, so most blocks of them can be skipped. The
outermost corner of a block's bounding box bounds all vertices in it, rounding included. The result
equals that of testing every vertex.

@returns vertices by direction. Directions may have any order; it is fast if neighbouring directions
are `stride` apart.
@pre vertices is not empty, all of them are finite, stride > 0. */
std::vector<size_t> FindOutermostVertices(const std::vector<Eigen::Vector3d>& vertices,
                                          const std::vector<Eigen::Vector3d>& directions,
                                          size_t stride);

struct RimCircle {
  Eigen::Vector3d p_OCentre;
  Eigen::Vector3d axis_O;  ///< unit
  double radius;           ///< through the mesh's vertices [m]
  std::vector<size_t> vertices;
};

/** Finds the circles that rims of a mesh represent.
@param outermost  by vertex: whether it can touch a plane. Only rings of such vertices count. */
std::vector<RimCircle> FindRimCircles(const TriMesh& mesh, const std::vector<bool>& outermost);

}  // namespace graspbench
