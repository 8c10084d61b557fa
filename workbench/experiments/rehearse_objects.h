#pragma once
/** @file
Rehearses grasps of hands on objects (datasets/plan/rehearsed_grasps.h) on several threads: for a
session before it starts, or into a folder of its own (datasets/scene/rehearsal_store.h), with
results that do not depend on the number of workers, to the byte. Stored results of earlier runs are
reused. */

#include <filesystem>
#include <vector>

#include "datasets/plan/rehearsed_grasps.h"
#include "datasets/scene/rehearsal_store.h"
#include "datasets/shards/shard.h"
#include "workbench/experiments/observer.h"

namespace graspbench {

/** Lists all hand-object pairs of the session, hands first.
@throws as LoadSessionInputs; Error(kRange) for a bad configuration. */
std::vector<RehearsalTask> ListRehearsalTasks(const SessionConfig& config,
                                              const RehearsalConfig& rehearsal);

/** Lists the rehearsals for the session's grasps "rehearsed" and "best", and for conditions that
make a new choice, unless they are stored or were found by an earlier run. */
std::vector<RehearsalTask> ListUnrehearsed(const SessionConfig& config);

/** Estimated processor time [s]; shown to the user, in no result. */
struct RehearsalTime {
  double candidates = 0.0;
  double postures = 0.0;  ///< search over all pairs, if requested
};
/** Estimates the time of all tasks from the first task of each hand, which is rehearsed without
postures and kept. A posture is assumed to cost as much as a candidate. 0 without a task. */
RehearsalTime EstimateRehearsalTime(const std::vector<RehearsalTask>& tasks);

/** Rehearses the tasks and stores the results. @throws Error(kInterrupted) when stopped; as
FindRehearsal. */
std::vector<Rehearsal> RehearseTasks(const std::vector<RehearsalTask>& tasks, int num_workers,
                                     Observer& observer);

struct RehearseRequest {
  std::vector<RehearsalTask> tasks;
  bool types_only = false;         ///< the tasks are from MakeTypeTask; writes types.json
  Shard shard;                     ///< of the tasks, assigned round-robin
  std::vector<std::string> parts;  ///< folders from which rehearsals of the same hash are taken
  std::filesystem::path out;
  int num_workers = 1;
};

/** Creates the folder, or continues it. @returns its content: the shard's pairs in their order.
@throws Error(kUsage) when the folder holds something else or was begun with another request;
Error(kInterrupted); kIo; as FindRehearsal. */
std::vector<RehearsedPair> RehearseObjects(const RehearseRequest& request, Observer& observer);

}  // namespace graspbench
