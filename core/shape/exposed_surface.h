#pragma once
/** @file
The part of a mesh that bounds its solid (line_crossings.h). */

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** The triangles with the solid on one side only; those inside it, where parts overlap or touch,
are left out. A triangle that is partly inside is cut into smaller ones, which no longer share
edges, until they are shorter than `resolution` [m]: the result is for distances, not a closed mesh.
@pre every edge has as many triangles in either direction. */
TriMesh FindExposedSurface(const TriMesh& mesh, double resolution);

}  // namespace graspbench
