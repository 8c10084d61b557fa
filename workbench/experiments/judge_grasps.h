#pragma once
/** @file
Judges grasps that others made under profiles (datasets/judged_grasps/grasp_store.h). The same
request again continues what was stopped, to the same bytes whatever the number of workers. */

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "datasets/judged_grasps/grasp_store.h"
#include "datasets/shards/shard.h"
#include "workbench/experiments/grasp_inputs.h"
#include "workbench/experiments/observer.h"

namespace graspbench {

struct JudgeGraspsRequest {
  std::vector<FreeSpaceProfile> profiles;
  int jitter = 0;  ///< disturbances of each grasp besides itself
  Shard shard;     ///< of the grasps, dealt in turn
  std::filesystem::path out;
  int num_workers = 1;
};

/** The frozen configuration of the request: inputs and profiles in full. */
Json DescribeRequest(const JudgeGraspsRequest& request, const GraspInputs& inputs);

/** @returns whether nothing is left; then the table is written.
@throws Error(kUsage) when the folder holds something else or was begun with another request;
kIo. */
bool JudgeGrasps(const JudgeGraspsRequest& request, const GraspInputs& inputs, Observer& observer);

/** One folder of all shards of a request, each in a folder of its own: journal and table are those
of a run that was never dealt.
@throws Error(kUsage) naming the shards that are missing, doubled or not finished, or what differs
between two folders; as LoadJudgedGrasps. */
void MergeJudgedGrasps(const std::vector<std::filesystem::path>& parts,
                       const std::filesystem::path& out);

/** Why a grasp passes under one profile and fails under another: from the first to the second one
value at a time, in the order of profile.yaml, each change kept. */
struct ExplainStep {
  std::string key;         ///< of profile.yaml; empty: the first profile as it is
  std::string from, to;    ///< its values
  FreeSpaceResult result;  ///< with this value and all before it
  bool turns = false;      ///< the verdict is another one than before
};

/** The last step is the second profile. */
std::vector<ExplainStep> ExplainGrasp(const GraspInputs& inputs, const GraspInput& input,
                                      const FreeSpaceProfile& from, const FreeSpaceProfile& to);

}  // namespace graspbench
