#pragma once
/** @file
Inputs for judging external grasps: the grasps read from files and mapped onto the hand, with their
objects. */

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/shape/grasp_object.h"
#include "core/trial/protocols/free_space.h"
#include "datasets/grasps/grasp_files.h"

namespace graspbench {

struct GraspInput {
  ForeignGrasp grasp;
  std::vector<ScriptedStage> stages;
  std::optional<ClosingTable> table;
  std::shared_ptr<const GraspObject> object;  ///< with the mesh in the grasp's scale
  std::set<size_t> unfit;                     ///< indices of profiles that cannot judge it
};

struct GraspInputs {
  std::shared_ptr<const Hand> hand;
  std::vector<bool> is_asked;      ///< by joint; see MakeProfiledHand
  std::vector<GraspInput> grasps;  ///< those that can be judged
  /** Unreadable files, grasps that the hand cannot execute, and unsuitable profiles, with
  reasons. */
  std::vector<UnreadFile> unread;
  Json description;  ///< hashes of all inputs, without paths
};

/** Finds the mesh that a file calls `name`, below `folder`. Tries the path itself and every
trailing part of it: as a file, with a mesh extension added, or as a folder with
mesh/simplified.obj, simplified.obj, mesh.obj or coacd/decomposed.obj. The longest part that exists
is taken.
@returns empty: no such mesh. @throws Error(kFormat) when several meshes match. */
std::filesystem::path FindObjectMesh(const std::filesystem::path& folder, const std::string& name);

/** Loads the inputs. A grasp whose mesh is missing or unusable is not judged. A grasp that states
only the open hand is judged under those profiles that close the hand.
@param hand  by id or folder. @param objects  folder of the meshes; empty: the current one.
@throws Error(kUsage) for two grasps of one name; Error(kFormat) when no grasp is left; as LoadHand,
DemandShortChains. */
GraspInputs LoadGraspInputs(GraspCollection collection, const std::string& hand,
                            const std::filesystem::path& objects,
                            const std::vector<FreeSpaceProfile>& profiles);

/** Name of a grasp in all messages and pages: "mug.npy, grasp 3". */
std::string NameGrasp(const ForeignGrasp& grasp);

/** Finds a grasp by number. @throws Error(kUsage) when there is no such grasp; kFormat when a
profile does not suit it. */
const GraspInput& FindGraspInput(const GraspInputs& inputs, int number);

/** Sets up hand, object and stages under a profile. @param jitter  0: none; else the grasp's root
is displaced at all stages by 1 mm and 1 degree, in directions seeded by this number. */
ProfiledScene MakeInputScene(const GraspInputs& inputs, const GraspInput& input,
                             const FreeSpaceProfile& profile, int jitter = 0);

FreeSpaceResult JudgeGraspInput(const GraspInputs& inputs, const GraspInput& input,
                                const FreeSpaceProfile& profile, int jitter = 0);

}  // namespace graspbench
