#pragma once
/** @file
A polygon of a mesh file, cut into triangles. */

#include <cstdint>
#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Appends triangles that turn like the polygon. A fan about its first corner where that is right
(every convex polygon); else ears are cut off (Meisters 1975), in time quadratic in the corners. A
polygon that crosses itself gives triangles too: they close what it closes.
@param corners  at least three valid indices into the mesh's vertices, in order.
@param work     corner tests still allowed, reduced by what was spent.
@returns false, and appends nothing, when the work does not suffice. */
bool AppendPolygon(const std::vector<int>& corners, TriMesh& mesh, int64_t& work);

}  // namespace graspbench
