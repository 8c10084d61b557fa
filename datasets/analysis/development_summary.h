#pragma once
/** @file
What the trials of a development were spent on, and what they gave. */

#include <string>
#include <vector>

#include "datasets/analysis/session_summary.h"
#include "datasets/scene/development_store.h"

namespace graspbench {

/** Part of the development of one grasp: "race", "search", "finals", "check". */
struct DevelopmentStage {
  std::string name;
  int num_requests = 0;     ///< postures on some shapes; one may be asked again with other draws
  double best_score = 0.0;  ///< largest mean score of a request
  Tally tally;              ///< of its trials
};

/** Of each grasp, in the order of development, its stages. A check ends a grasp; what was stopped
before has none. */
std::vector<std::vector<DevelopmentStage>> SummariseDevelopment(const DevelopmentJournal& journal);

}  // namespace graspbench
