#pragma once
/** @file
Compares two sessions trial by trial, in the pairs of datasets/analysis/pairs.h, under each
condition that both have. If each session has only one hand, the hands are compared.

Where an object's grasp differs between the sessions, some pairs also change their grasp. Then there
are two estimates: over all pairs, and over those with the same grasp. If all pairs change their
grasp, the grasps are compared.

If both have grip thresholds on the same scale, these are also compared draw by draw. A draw that no
grip held counts as above every other. */

#include <string>
#include <vector>

#include "datasets/analysis/conditions/sensitivity_summary.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/pairs.h"

namespace graspbench {

struct TrialPair {
  const TrialRecord* before = nullptr;
  const TrialRecord* after = nullptr;

  /** Grasps of different hands are not compared, although they have the same names. */
  bool changes_grasp() const {
    return before->plan.hand == after->plan.hand && FindUsedGrasp(*before) != FindUsedGrasp(*after);
  }
  bool is_won() const { return !IsSuccess(before->result.outcome) && is_success_after(); }
  bool is_lost() const { return IsSuccess(before->result.outcome) && !is_success_after(); }

 private:
  bool is_success_after() const { return IsSuccess(after->result.outcome); }
};

struct SessionComparison {
  std::vector<TrialPair> pairs;  ///< in the order of the first session's plan
  /** The two hands, where each session has one and they differ; else empty. */
  std::string hand, other_hand;
  int num_only_before = 0;  ///< finished trials that are in no pair
  int num_only_after = 0;
  /** By hand: "all pairs", then, where some pairs of one hand change their grasp, "same grasp".
  `hand` is that of the first session. */
  std::vector<SettingChange> changes;

  int num_other_grasp() const;
  std::vector<std::string> settings;  ///< "sim.step_s: 0.002 and 0.001"
};

/** Compares two sessions, whose records must outlive the result. Changes are the second session
minus the first.
@throws Error(kUsage) when there is no pair, saying why. */
SessionComparison CompareSessions(const Session& before, const Session& after);

struct ThresholdChange {
  const ThresholdScale* scale = nullptr;
  std::string hand;  ///< of the first session
  int num_pairs = 0;
  int num_lower = 0, num_equal = 0, num_higher = 0;  ///< in the second session
  /** Median ratio of the second session's threshold to the first's, over pairs in which both have
  one, with the 95 % interval of order statistics; NaN: too few pairs. */
  double ratio = kUnset, low = kUnset, high = kUnset;
  int num_left_out = 0;  ///< pairs of the hand without a threshold in both sessions
  int num_infinite = 0;  ///< of num_pairs: no grip held in one session, so there is no ratio
};

/** Compares thresholds by scale, then by hand; empty where one session has none. */
std::vector<ThresholdChange> CompareThresholds(const std::vector<TrialPair>& pairs,
                                               const std::vector<ThresholdSummary>& before,
                                               const std::vector<ThresholdSummary>& after);

std::vector<CsvColumn<ThresholdChange>> ListThresholdChangeColumns();

}  // namespace graspbench
