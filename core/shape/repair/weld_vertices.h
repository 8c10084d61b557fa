#pragma once
/** @file
Joins coincident vertices, so that neighbouring triangles share them. */

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Of a mesh's largest coordinate or extent: what two vertices of one corner are apart when a file
wrote it twice. Single precision keeps seven digits. */
inline constexpr double kRelativeWeldTolerance = 1e-6;

/** Vertices within `tolerance` [m] of an earlier one become that one; triangles that lose a corner
and vertices that no triangle uses are dropped. The order of what remains is kept.
@param may_join  by vertex; those that may not stay as they are. Empty: all may.
@pre finite vertices, valid indices, tolerance > 0. */
TriMesh WeldVertices(const TriMesh& mesh, double tolerance, const std::vector<bool>& may_join = {});

}  // namespace graspbench
