#pragma once
/** @file
Grip thresholds of two sessions draw by draw, where both have looked for them on the same scale: the
draws are those that CompareSessions (session_comparison.h) has paired. A draw that no grip held is
above every other. */

#include <string>
#include <vector>

#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/session_comparison.h"

namespace graspbench {

struct ThresholdChange {
  const ThresholdScale* scale = nullptr;
  std::string hand;  ///< of the first session
  int num_pairs = 0;
  int num_lower = 0, num_equal = 0, num_higher = 0;  ///< in the second session
  /** Of the second session's over the first's, of the pairs in which both have one; its interval is
  that of order statistics, NaN: too few. */
  double ratio = kUnset, low = kUnset, high = kUnset;
};

/** By scale, then by hand. None where one of them has no thresholds. */
std::vector<ThresholdChange> CompareThresholds(const std::vector<TrialPair>& pairs,
                                               const std::vector<ThresholdSummary>& before,
                                               const std::vector<ThresholdSummary>& after);

Json ToJson(const std::vector<ThresholdChange>& changes);

}  // namespace graspbench
