#pragma once
/** @file
Turns a URDF of our own form into the hand's tree, its collision shapes and its looks. */

#include <filesystem>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/hand/contact_shape.h"
#include "core/hand/hand.h"
#include "core/hand/read_urdf.h"

namespace graspbench {

/** Fills links (depth first, siblings by their joints' names), joints and visuals of `hand`; a hand
without any visual looks like its collision shapes. Drives, coupling and the root's pose are left
unset.
@param urdf  read without errors. @param folder  meshes are found relative to it; faults within them
are reported. */
std::vector<CollisionShape> BuildHand(const Urdf& urdf, const std::filesystem::path& folder,
                                      Hand& hand, Diagnostics& problems);

}  // namespace graspbench
