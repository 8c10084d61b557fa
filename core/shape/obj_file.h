#pragma once
/** @file
Wavefront OBJ, restricted to shape: `v` and `f`. Used for the project's own meshes and for the
appearance of hands; objects/ reads a user's objects in other formats. */

#include <string>

#include "core/base/error.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Parses an OBJ file. Polygons are triangulated; texture and normal indices and all other
statements are ignored, so a material library is never opened. Run time grows with the text. Concave
polygons take up to a second in total; beyond that they are rejected. A bad line is added to
`problems`; the first one stops parsing and gives an empty mesh. */
TriMesh ParseObj(const std::string& text, const std::string& file, Diagnostics& problems);

/** Formats a mesh. Coordinates have six decimals and are in metres unless `units_per_metre` differs
(1000: millimetres). The same mesh gives the same bytes. */
std::string FormatObj(const TriMesh& mesh, double units_per_metre = 1.0);

}  // namespace graspbench
