#pragma once
/** @file
What is needed to judge grasps that others made: read from their files, mapped onto the hand, with
the objects they are of. */

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
  std::shared_ptr<const GraspObject> object;  ///< its mesh in the grasp's scale
  std::set<size_t> unfit;                     ///< indices of profiles that cannot judge it
};

struct GraspInputs {
  std::shared_ptr<const Hand> hand;
  std::vector<bool> is_asked;      ///< by joint: see MakeProfiledHand
  std::vector<GraspInput> grasps;  ///< that can be judged
  /** Files, grasps that the hand cannot do, profiles that do not fit; with the reason. */
  std::vector<UnreadFile> unread;
  Json description;  ///< hashes of all of it, without names of places
};

/** The mesh that a file means by `name`, below `folder`: the path itself or any end of it, as a
file, with an ending of a mesh, or a folder with mesh/simplified.obj, simplified.obj or mesh.obj.
The longest end that there is counts. @returns empty: there is none.
@throws Error(kFormat) when more than one mesh is meant by it. */
std::filesystem::path FindObjectMesh(const std::filesystem::path& folder, const std::string& name);

/** @param hand  by id or folder.   @param objects  folder of the meshes; empty: the current one.
A grasp whose mesh is missing or of no use is not judged. One that states the open hand alone is
judged under those profiles that close it.
@throws Error(kUsage) for two grasps of one name; Error(kFormat) when no grasp is left; as LoadHand,
DemandShortChains. */
GraspInputs LoadGraspInputs(GraspCollection collection, const std::string& hand,
                            const std::filesystem::path& objects,
                            const std::vector<FreeSpaceProfile>& profiles);

/** "mug.npy, grasp 3", the same in every message and page. */
std::string NameGrasp(const ForeignGrasp& grasp);

/** @throws Error(kUsage) when there is no such grasp; kFormat when a profile does not fit it. */
const GraspInput& FindGraspInput(const GraspInputs& inputs, int number);

/** Hand, object and stages under a profile. @param jitter  0: as it is; else its root is disturbed
at all stages
by 1 mm and 1 degree in directions drawn from this number. */
ProfiledScene MakeInputScene(const GraspInputs& inputs, const GraspInput& input,
                             const FreeSpaceProfile& profile, int jitter = 0);

FreeSpaceResult JudgeGraspInput(const GraspInputs& inputs, const GraspInput& input,
                                const FreeSpaceProfile& profile, int jitter = 0);

}  // namespace graspbench
