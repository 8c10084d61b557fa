#pragma once
/** @file
Reads a hand: `hand.urdf` (kinematics, inertia, collision and visual shapes, limits) and `hand.yaml`
(digits, pads, drives, coupling; standard grasps are read by core/grasp).

Collision shapes become contact geometry. A sphere stays a sphere. A cylinder is treated as the
capsule of the same axis and radius and is sampled by spheres. A box is filled by rows of capsules
of half its thickness (contact_shape.h). A shape named "cover" touches objects and the table only; a
shape named "self_contact" touches other links of the hand only. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/hand/hand.h"

namespace graspbench {

/** Ids of the bundled hands: the folders of core/hand/models, sorted. */
std::vector<std::string> ListHands();

/** @param id_or_folder  a known id, or the path of a folder with hand.urdf and hand.yaml.
@throws Error(kNotFound) with suggestions; Error(kFormat) listing every problem with file and line.
*/
Hand LoadHand(const std::string& id_or_folder);

/** As LoadHand, but collects problems and warnings instead of throwing. The hand is usable only if
`problems` contains no error. */
Hand CheckHand(const std::string& id_or_folder, Diagnostics& problems);

/** As CheckHand, from the texts of hand.urdf and hand.yaml. @param folder  gives the hand its id;
mesh paths are relative to it. */
Hand ParseHand(const std::string& urdf, const std::string& yaml,
               const std::filesystem::path& folder, Diagnostics& problems);

}  // namespace graspbench
