#pragma once
/** @file
What `graspbench compare` shows of two sessions. */

#include <string>
#include <vector>

#include "datasets/analysis/controller_comparison.h"
#include "datasets/analysis/session_comparison.h"
#include "datasets/analysis/type_summary.h"

namespace graspbench {

struct ComparedSessions {
  SessionComparison comparison;
  std::vector<ThresholdChange> thresholds;
  std::vector<ObjectComparison> objects;
  std::vector<HandDecision> decisions;
  std::vector<LoadChange> loads;
  std::vector<TypeSummary> types_before, types_after;
};

/** Compares all that both have; the sessions must outlive the result.
@throws as CompareSessions. */
ComparedSessions CompareAll(const Session& before, const Session& after);

/** Of two hands the rows are named "B minus A". */
std::string FormatComparison(const ComparedSessions& result);
Json ToJson(const ComparedSessions& result);

/** One row per scale and hand; empty without any. */
std::string FormatThresholdChanges(const std::vector<ThresholdChange>& changes);

}  // namespace graspbench
