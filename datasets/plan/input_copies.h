#pragma once
/** @file
The user's own hands, objects and grasp files, copied into the folder of a session, an optimisation
or a campaign when it is made:

    inputs/hands/<id>/     hand.urdf, hand.yaml and the meshes that hand.urdf names
    inputs/objects/<id>/   object.yaml, its mesh and the files that a .gltf names
    inputs/grasps/<n>.yaml the n-th of the configuration's grasps, from 0

What comes with the program is not copied. The copies are sealed with the store; whoever continues
or reads it takes them, wherever it was moved to and whatever became of the originals. The scenes
and the benchmark of a campaign have no copies of their own: theirs are the campaign's; nor do the
experiments in a session's folder. */

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/plan/session_config.h"

namespace graspbench {

/** True for a name that stands for a grasp file and not for a grasp's id. */
bool IsGraspFile(const std::string& name);

/** @pre LoadSessionInputs(config) has found them usable. @throws Error(kUsage) for a file that is
named from outside its hand's or object's folder; Error(kIo). */
void CopyInputs(const SessionConfig& config, const std::filesystem::path& folder);

/** hand.urdf, hand.yaml and the meshes that hand.urdf names, into the folder `to`.
@throws Error(kUsage) for a file that is named from outside the folder; Error(kIo). */
void CopyHand(const std::filesystem::path& from, const std::filesystem::path& to);

/** As CopyHand, but meshes named from outside the folder are put into `meshes` and hand.urdf names
them there: a hand of its own, not a copy to the byte. @throws Error(kIo). */
void GatherHand(const std::filesystem::path& from, const std::filesystem::path& to);

/** Where to load an input from: its copy in the store's folder, else the name itself.
@param folder  empty: there is no store yet. */
std::string FindHandInput(const std::string& name, const std::filesystem::path& folder);
std::string FindObjectInput(const std::string& name, const std::filesystem::path& folder);
/** @param number  in the configuration's list of grasps. */
std::string FindGraspInput(const std::string& name, size_t number,
                           const std::filesystem::path& folder);

/** Files of the grasps of this id that the scenes of a campaign have found.
@param folder  of the campaign's benchmark; none for any other. */
std::vector<std::string> ListSceneGrasps(const std::string& id,
                                         const std::filesystem::path& folder);

}  // namespace graspbench
