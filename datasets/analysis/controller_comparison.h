#pragma once
/** @file
Controllers on the same draws: which of two succeeds more often, object by object; what neither
holds; what their grasps bear; and how success changes over sessions that followed each other. */

#include <optional>
#include <string>
#include <vector>

#include "core/statistics/paired_clusters.h"
#include "datasets/analysis/session_comparison.h"

namespace graspbench {

/** One object in one hand. */
struct ObjectComparison {
  std::string hand, object;  ///< of the first session
  PairedCounts successes;    ///< first: of the first session
};
/** In the order of the pairs. */
std::vector<ObjectComparison> CompareObjects(const std::vector<TrialPair>& pairs);

/** Whether the two of a hand differ, by the exact test clustered by object. */
struct HandDecision {
  std::string hand;
  PairedCounts successes;
  int num_objects = 0;
  double p = kUnset;
  /** Pairs on these objects that decide a difference of 10 points in 80 % of comparisons, by the
  share of pairs that differ here and the spread between these objects. */
  std::optional<int> num_pairs_needed;
};
inline constexpr double kPlannedDifference = 0.1;
std::vector<HandDecision> DecideByObject(const std::vector<ObjectComparison>& objects);

/** Smallest breaking forces of the pairs that were judged in both. */
struct LoadChange {
  std::string hand;
  int num_pairs = 0;
  double before = kUnset, after = kUnset;              ///< medians [N]
  double ratio = kUnset, low = kUnset, high = kUnset;  ///< median of second over first; see below
  int num_left_out = 0;  ///< pairs of the hand that were not judged in both, or broke at no force
};
/** The interval is that of order statistics, NaN: too few pairs. None where nothing was judged. */
std::vector<LoadChange> CompareLoads(const std::vector<TrialPair>& pairs);

/** One session among others. */
struct LearningPoint {
  std::string name;     ///< of its folder
  std::string command;  ///< of its policy; empty: the strategy
  int num_trials = 0, num_successes = 0;
  double rate = kUnset;
  Interval interval = {0.0, 1.0};  ///< 95 %, Wilson
  int num_pairs = 0;               ///< with the first session, on the same draws
  double change = kUnset, change_low = kUnset, change_high = kUnset;  ///< of the rate, over these
  double p = kUnset;  ///< of the exact test clustered by hand and object
};
/** @param sessions  in their order, with their names; they must outlive nothing. */
std::vector<LearningPoint> ListLearningPoints(
    const std::vector<std::pair<std::string, const Session*>>& sessions);

std::vector<CsvColumn<ObjectComparison>> ListObjectComparisonColumns();
std::vector<CsvColumn<HandDecision>> ListHandDecisionColumns();
std::vector<CsvColumn<LoadChange>> ListLoadChangeColumns();
std::vector<CsvColumn<LearningPoint>> ListLearningColumns();

}  // namespace graspbench
