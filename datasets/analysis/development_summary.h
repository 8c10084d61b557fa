#pragma once
/** @file
Summarises a grasp development: how its trials were spent and what they achieved. */

#include <string>
#include <vector>

#include "datasets/analysis/session_summary.h"
#include "datasets/scene/development_store.h"

namespace graspbench {

/** A stage in the development of one grasp: "race", "search", "finals" or "check". */
struct DevelopmentStage {
  std::string name;
  int num_requests = 0;     ///< evaluations of a posture on some shapes; may recur with new draws
  double best_score = 0.0;  ///< largest mean score of any request
  Tally tally;              ///< of its trials
};

/** Returns the stages of each grasp, in the order of development. The last stage of a grasp is its
check; a development that was stopped earlier has none. */
std::vector<std::vector<DevelopmentStage>> SummariseDevelopment(const DevelopmentJournal& journal);

}  // namespace graspbench
