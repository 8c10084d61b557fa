#pragma once
/** @file
Foreign mesh files: whatever the packaged assimp reads (OBJ, STL, PLY, glTF, COLLADA, ...),
all parts of the file as one mesh, with the transforms of its scene applied. */

#include <filesystem>
#include <string>

#include "core/shape/tri_mesh.h"
#include "objects/length_unit.h"

namespace graspbench {

/** In metres, coincident vertices welded. Axes as in the file. Not checked: see
core/shape/mesh_check.h. Vertices may be non-finite.
@throws Error(kNotFound, kIo); Error(kFormat) when assimp cannot read it as a triangle mesh. */
TriMesh LoadMesh(const std::filesystem::path& path, LengthUnit unit);

/** The same from the content of a file that stands alone; `name` tells the format by its ending. */
TriMesh ParseMesh(const std::string& bytes, const std::string& name, LengthUnit unit);

}  // namespace graspbench
