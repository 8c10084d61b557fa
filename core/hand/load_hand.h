#pragma once
/** @file
Reads a hand: `hand.urdf` (kinematics, inertia, collision and visual shapes, limits) and `hand.yaml`
(digits, pads, drives, coupling; standard grasps are read by core/grasp).

Collision shapes become contact: a sphere stays one; a cylinder is taken as the capsule of the same
axis and radius and is sampled by spheres; a box is filled by rows of capsules of its half
thickness (contact_shape.h). One that is named "cover" is met by objects and the table
alone, one that is named "self_contact" by other links of the hand alone. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/hand/hand.h"

namespace graspbench {

/** Ids of the hands that come with the program: the folders of core/hand/models, sorted. */
std::vector<std::string> ListHands();

/** @param id_or_folder  a known id, or the path of a folder with hand.urdf and hand.yaml.
@throws Error(kNotFound) with suggestions; Error(kFormat) listing every problem with file and line.
*/
Hand LoadHand(const std::string& id_or_folder);

/** As LoadHand, but collects the problems (warnings too) instead of throwing on them. The hand is
usable only when `problems` holds no error. */
Hand CheckHand(const std::string& id_or_folder, Diagnostics& problems);

/** As CheckHand, from the texts of hand.urdf and hand.yaml. @param folder  names the hand, and
meshes are found relative to it. */
Hand ParseHand(const std::string& urdf, const std::string& yaml,
               const std::filesystem::path& folder, Diagnostics& problems);

}  // namespace graspbench
