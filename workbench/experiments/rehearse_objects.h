#pragma once
/** @file
Rehearses grasps of hands on objects (datasets/plan/rehearsed_grasps.h) on several threads: for a
session before it starts, or into a folder of its own (datasets/scene/rehearsal_store.h), to the
same bytes whatever the number of workers. What an earlier run has found is not run again. */

#include <filesystem>
#include <vector>

#include "datasets/plan/rehearsed_grasps.h"
#include "datasets/scene/rehearsal_store.h"
#include "datasets/shards/shard.h"
#include "workbench/experiments/observer.h"

namespace graspbench {

/** Every pair of a hand and an object of the session, in this order.
@throws as LoadSessionInputs; Error(kRange) for a bad configuration. */
std::vector<RehearsalTask> ListRehearsalTasks(const SessionConfig& config,
                                              const RehearsalConfig& rehearsal);

/** Of a session's grasps "rehearsed" and "best", and of conditions that choose again, those that are
not stored and that no earlier run has found. */
std::vector<RehearsalTask> ListUnrehearsed(const SessionConfig& config);

/** Processor time: for a person, in no result [s]. */
struct RehearsalTime {
  double candidates = 0.0;
  double postures = 0.0;  ///< of a search of all pairs, where one is asked for
};
/** Of all tasks, by the first of each hand, which is rehearsed without postures and kept. A posture
takes as long as a candidate. 0 without a task. */
RehearsalTime EstimateRehearsalTime(const std::vector<RehearsalTask>& tasks);

/** Rehearses and keeps what was found. @throws Error(kInterrupted) when stopped; as FindRehearsal.
*/
std::vector<Rehearsal> RehearseTasks(const std::vector<RehearsalTask>& tasks, int num_workers,
                                     Observer& observer);

struct RehearseRequest {
  std::vector<RehearsalTask> tasks;
  bool types_only = false;         ///< the tasks are those of MakeTypeTask; writes types.json
  Shard shard;                     ///< of the tasks, dealt in turn
  std::vector<std::string> parts;  ///< folders that rehearsals of the same hash come from
  std::filesystem::path out;
  int num_workers = 1;
};

/** Makes the folder, or continues it. @returns what it holds, the shard's pairs in their order.
@throws Error(kUsage) when the folder holds something else or was begun with another request;
Error(kInterrupted); kIo; as FindRehearsal. */
std::vector<RehearsedPair> RehearseObjects(const RehearseRequest& request, Observer& observer);

}  // namespace graspbench
