#pragma once
/** @file
Judges external grasps under profiles (datasets/judged_grasps/grasp_store.h). Repeating a request
continues a stopped one. The results do not depend on the number of workers, to the byte. */

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
  int jitter = 0;  ///< number of perturbed copies of each grasp
  Shard shard;     ///< of the grasps, assigned round-robin
  std::filesystem::path out;
  int num_workers = 1;
};

/** Returns the frozen configuration of the request: inputs and profiles in full. */
Json DescribeRequest(const JudgeGraspsRequest& request, const GraspInputs& inputs);

/** Judges the remaining grasps. @returns whether nothing is left; the table is then written.
@throws Error(kUsage) when the folder holds something else or was begun with another request;
kIo. */
bool JudgeGrasps(const JudgeGraspsRequest& request, const GraspInputs& inputs, Observer& observer);

/** Merges the shards of a request, each in its own folder. Journal and table equal those of an
unsharded run.
@throws Error(kUsage) naming the shards that are missing, duplicate or unfinished, or the difference
between two folders; as LoadJudgedGrasps. */
void MergeJudgedGrasps(const std::vector<std::filesystem::path>& parts,
                       const std::filesystem::path& out);

/** A step in explaining why a grasp passes under one profile and fails under another. From the
first profile to the second, values are changed one at a time, in the order of profile.yaml, and
stay changed. */
struct ExplainStep {
  std::string key;         ///< of profile.yaml; empty: the unchanged first profile
  std::string from, to;    ///< old and new value
  FreeSpaceResult result;  ///< with this change and all before it
  bool turns = false;      ///< the verdict changes at this step
};

/** Lists the steps; the last one is the second profile. */
std::vector<ExplainStep> ExplainGrasp(const GraspInputs& inputs, const GraspInput& input,
                                      const FreeSpaceProfile& from, const FreeSpaceProfile& to);

}  // namespace graspbench
