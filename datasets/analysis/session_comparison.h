#pragma once
/** @file
Two sessions trial by trial, in the pairs of datasets/analysis/pairs.h, under each condition that
both have. Hands are what is compared where each session has only one.

Where an object's grasp differs between the sessions, some pairs change grasp with everything else.
Then there are two estimates: of all pairs, and of those with the same grasp. Where all pairs change
grasp, grasps are what is compared.

Where both have looked for grip thresholds on the same scale, these are compared draw by draw, too. A
draw that no grip held is above every other. */

#include <string>
#include <vector>

#include "datasets/analysis/conditions/sensitivity_summary.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/pairs.h"

namespace graspbench {

struct TrialPair {
  const TrialRecord* before = nullptr;
  const TrialRecord* after = nullptr;

  bool changes_grasp() const { return FindUsedGrasp(*before) != FindUsedGrasp(*after); }
  bool is_won() const { return !IsSuccess(before->result.outcome) && is_success_after(); }
  bool is_lost() const { return IsSuccess(before->result.outcome) && !is_success_after(); }

 private:
  bool is_success_after() const { return IsSuccess(after->result.outcome); }
};

struct SessionComparison {
  std::vector<TrialPair> pairs;  ///< in the order of the first session's plan
  int num_only_before = 0;       ///< finished trials that are in no pair
  int num_only_after = 0;
  /** Of all pairs of a hand, "all pairs", then of its pairs with the same grasp where some have
  another: "same grasp". `hand` is the first's. */
  std::vector<SettingChange> changes;

  int num_other_grasp() const;
  std::vector<std::string> settings;  ///< "sim.step_s: 0.002 and 0.001"
};

/** The records must outlive what is found.
@throws Error(kUsage) when there is no pair, saying why. */
SessionComparison CompareSessions(const Session& before, const Session& after);

struct ThresholdChange {
  const ThresholdScale* scale = nullptr;
  std::string hand;  ///< of the first session
  int num_pairs = 0;
  int num_lower = 0, num_equal = 0, num_higher = 0;  ///< in the second session
  /** Of the second session's over the first's, of the pairs in which both have one; its interval is
  that of order statistics, NaN: too few. */
  double ratio = kUnset, low = kUnset, high = kUnset;
  int num_left_out = 0;  ///< pairs of the hand without a threshold in both sessions
  int num_infinite = 0;  ///< of num_pairs: no grip held in one of them, so that there is no ratio
};

/** By scale, then by hand. None where one of them has no thresholds. */
std::vector<ThresholdChange> CompareThresholds(const std::vector<TrialPair>& pairs,
                                               const std::vector<ThresholdSummary>& before,
                                               const std::vector<ThresholdSummary>& after);

std::vector<CsvColumn<ThresholdChange>> ListThresholdChangeColumns();

}  // namespace graspbench
