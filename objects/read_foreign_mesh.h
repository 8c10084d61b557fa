#pragma once
/** @file
Reads mesh files behind the fence (core/fence): OBJ with core/shape, the others with assimp. Only
graspbench-reader links this file and thus assimp. */

#include <functional>
#include <optional>
#include <string>

#include "core/fence/serve_fence.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

using ReadBeside = std::function<std::optional<std::string>(const std::string& name)>;

/** Reads all parts of a mesh file. Coordinates are as in the file, not welded and perhaps not
finite.
@param format  obj, stl, ply, glb, gltf or dae. @param name  for messages.
@param read_beside  returns the content of a file that the glTF refers to.
@throws Error(kFormat). */
TriMesh ReadForeignMesh(const std::string& bytes, const std::string& format,
                        const std::string& name, const ReadBeside& read_beside);

FencedReader MakeMeshReader();

}  // namespace graspbench
