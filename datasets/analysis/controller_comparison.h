#pragma once
/** @file
Compares controllers on the same draws: which of two succeeds more often on each object, what
neither holds, the breaking forces of their grasps, and how success changes over successive
sessions. */

#include <optional>
#include <string>
#include <vector>

#include "core/statistics/paired_clusters.h"
#include "datasets/analysis/session_comparison.h"

namespace graspbench {

/** One object in one hand. */
struct ObjectComparison {
  std::string hand, object;  ///< of the first session
  PairedCounts successes;    ///< first: the first session
};
/** In the order of the pairs. */
std::vector<ObjectComparison> CompareObjects(const std::vector<TrialPair>& pairs);

/** Whether the two sessions differ for a hand, by the exact test clustered by object. */
struct HandDecision {
  std::string hand;
  PairedCounts successes;
  int num_objects = 0;
  double p = kUnset;
  /** Number of pairs on these objects that detects a difference of 10 points with 80 % power, given
  the observed share of discordant pairs and the spread between objects. */
  std::optional<int> num_pairs_needed;
};
inline constexpr double kPlannedDifference = 0.1;
std::vector<HandDecision> DecideByObject(const std::vector<ObjectComparison>& objects);

/** Breaking forces of the pairs whose trials were both judged. */
struct LoadChange {
  std::string hand;
  int num_pairs = 0;
  double before = kUnset, after = kUnset;              ///< medians [N]
  double ratio = kUnset, low = kUnset, high = kUnset;  ///< median of second / first; 95 % interval
  int num_left_out = 0;  ///< pairs of the hand without a breaking force > 0 in both sessions
};
/** Compares breaking forces by hand. Intervals are those of order statistics; NaN: too few pairs.
Hands without such a pair are left out. */
std::vector<LoadChange> CompareLoads(const std::vector<TrialPair>& pairs);

/** One of several successive sessions. */
struct LearningPoint {
  std::string name;     ///< of its folder
  std::string command;  ///< of its policy; empty: the strategy controls
  int num_trials = 0, num_successes = 0;
  double rate = kUnset;
  Interval interval = {0.0, 1.0};  ///< 95 %, Wilson
  int num_pairs = 0;               ///< with the first session, same draws
  double change = kUnset, change_low = kUnset, change_high = kUnset;  ///< of the rate, over these
  double p = kUnset;  ///< of the exact test clustered by hand and object
};
/** @param sessions  in their order, with their names. */
std::vector<LearningPoint> ListLearningPoints(
    const std::vector<std::pair<std::string, const Session*>>& sessions);

std::vector<CsvColumn<ObjectComparison>> ListObjectComparisonColumns();
std::vector<CsvColumn<HandDecision>> ListHandDecisionColumns();
std::vector<CsvColumn<LoadChange>> ListLoadChangeColumns();
std::vector<CsvColumn<LearningPoint>> ListLearningColumns();

}  // namespace graspbench
