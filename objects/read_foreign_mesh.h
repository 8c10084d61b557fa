#pragma once
/** @file
The reader of mesh files behind the fence (core/fence): OBJ by core/shape, the others by assimp. Only
graspbench-reader links it, and with it assimp. */

#include <functional>
#include <optional>
#include <string>

#include "core/fence/serve_fence.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

using ReadBeside = std::function<std::optional<std::string>(const std::string& name)>;

/** Coordinates as in the file, every part of it; not welded, perhaps not finite.
@param format  obj, stl, ply, glb, gltf or dae. @param name  for messages.
@param read_beside  the content of a file that a glTF names.
@throws Error(kFormat). */
TriMesh ReadForeignMesh(const std::string& bytes, const std::string& format,
                        const std::string& name, const ReadBeside& read_beside);

FencedReader MakeMeshReader();

}  // namespace graspbench
