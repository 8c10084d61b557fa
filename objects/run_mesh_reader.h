#pragma once
/** @file
Runs graspbench-mesh-reader (mesh_reader.cc) on the bytes of one file. */

#include <filesystem>
#include <string>

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Coordinates as in the file, every part of it; not welded, perhaps not finite.
@param bytes   the file's content.
@param format  stl, ply, glb, gltf or dae.
@param folder  where the files lie that a glTF names; empty: nowhere.
@param name    of the file, for messages.
@throws Error(kFormat) when it is no such file, or reading it took more time or memory than allowed,
or crashed; Error(kEnvironment) when the reader cannot be started. Safe with threads. */
TriMesh RunMeshReader(const std::string& bytes, const std::string& format,
                      const std::filesystem::path& folder, const std::string& name);

}  // namespace graspbench
