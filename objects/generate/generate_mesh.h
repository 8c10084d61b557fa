#pragma once
/** @file
Draws the catalogue's meshes; see main.cc. */

#include <filesystem>
#include <string>

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** The drawn shape of a catalogue object, exactly of `size` [m], its bounding box centred at O.
@throws Error(kNotFound) for an id that has no drawing. */
TriMesh GenerateMesh(const std::string& id, const Eigen::Vector3d& size);

/** Writes `FOLDER/ID/mesh.obj` for every drawing, sized by `FOLDER/ID/object.yaml`. */
void GenerateMeshes(const std::filesystem::path& folder);

}  // namespace graspbench
