#pragma once
/** @file
Judges grasps that others made under profiles (datasets/judged_grasps/grasp_store.h). The same
request again continues what was stopped, to the same bytes whatever the number of workers. */

#include <atomic>
#include <filesystem>
#include <vector>

#include "datasets/judged_grasps/grasp_store.h"
#include "workbench/experiments/grasp_inputs.h"
#include "workbench/experiments/observer.h"

namespace graspbench {

struct JudgeGraspsRequest {
  std::vector<std::string> profiles = {"dexgraspbench-fc"};  ///< by name or file
  int jitter = 0;  ///< disturbances of each grasp besides itself
  std::filesystem::path out;
  int num_workers = 1;
};

/** The frozen configuration of the request: inputs and profiles in full. */
Json DescribeRequest(const JudgeGraspsRequest& request, const GraspInputs& inputs,
                     const std::vector<FreeSpaceProfile>& profiles);

/** @returns whether nothing is left; then the table is written.
@throws Error(kUsage) when the folder holds something else or was begun with another request;
as LoadProfile; kIo. */
bool JudgeGrasps(const JudgeGraspsRequest& request, const GraspInputs& inputs, Observer& observer,
                 const std::atomic<bool>& stop);

}  // namespace graspbench
