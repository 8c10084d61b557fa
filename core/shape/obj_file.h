#pragma once
/** @file
Wavefront OBJ, the part that carries shape: `v` and `f`. For meshes that belong to the project and
for the looks of a hand; other formats of a user's object are read in objects/. */

#include <string>

#include "core/base/error.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Polygons are cut into triangles; texture and normal indices and all other statements
are skipped: a material library is never opened. Time grows with the text; polygons that are not
convex cost up to a second together, then they are refused. A bad line goes into `problems`; the
first one ends the reading with an empty mesh. */
TriMesh ParseObj(const std::string& text, const std::string& file, Diagnostics& problems);

/** Coordinates with six decimals, in metres unless another number of units per metre is given
(1000: millimetres). The same mesh gives the same bytes. */
std::string FormatObj(const TriMesh& mesh, double units_per_metre = 1.0);

}  // namespace graspbench
