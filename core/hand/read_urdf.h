#pragma once
/** @file
Turns a checked URDF into the hand's tree, its collision shapes and its looks. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/hand/contact_shape.h"
#include "core/hand/hand.h"

namespace graspbench {

/** Fills links (depth first, siblings by their joints' names), joints and visuals of `hand`; a hand
without any visual looks like its collision shapes. Drives, coupling and the root's pose are left
unset.
@param document  of CheckUrdf, so without errors. @param file  its name in messages.
@param folder  meshes are found relative to it. */
std::vector<CollisionShape> ReadUrdf(const std::string& document, const std::string& file,
                                     const std::filesystem::path& folder, Hand& hand,
                                     Diagnostics& problems);

}  // namespace graspbench
