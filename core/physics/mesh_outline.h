#pragma once
/** @file
What of a mesh can touch a plane: the vertices farthest out, and the circles that its rims stand for.

A can, a coin or a cone is round about one
axis, but its mesh is a polygon there, and a rigid polygon that rolls is braked by every edge: of 48
sides a solid cylinder keeps (1/2 + cos a) / (3/2), a = 7.5 degrees, of its speed at each. So rings
of equal sides that turn by less than 19 degrees each and cover most of a turn carry as circles.

Ridges of an even relief, such as the dimples of a golf ball, are rings about many axes; only axes
about which much of the outside is round count. Prisms of 17 to 23 sides are near that limit: of
18 sides or fewer they stay polygons, of 19 or more they roll as circles. */

#include <Eigen/Core>
#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** The vertex farthest out in each of many directions, v(d) = argmax d . v, the first of equals.

Vertices that follow each other in a mesh lie near each other, so that most blocks of them are
passed over: the extent of the corner of a block's bounding box that lies farthest out is, rounding
included, not below that of any vertex in it. The answer is that of trying every vertex.

@returns by direction. The directions' order is free; neighbours that follow each other `stride`
apart make it fast.
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

/** @param outermost  by vertex: it can touch a plane. Only rings of such vertices are looked at. */
std::vector<RimCircle> FindRimCircles(const TriMesh& mesh, const std::vector<bool>& outermost);

}  // namespace graspbench
