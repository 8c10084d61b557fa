#pragma once
/** @file
Trials of the same draws under two conditions or in two sessions: which belong together, and what
the change between them is. Sweeps, sensitivity, delays, numerics and comparisons of sessions all
pair and estimate here, so that one question has one answer.

A draw is one hand, object and number of a trial, with the object in the very same place. Its trials
are compared whatever grasp each of them was done with; only an object that one of the sides grasps
in several ways is compared grasp by grasp. What has no partner is counted.

The change of a measure is the mean over the draws of its differences. Draws of one object are
alike, so the 95 % interval comes from drawing objects (core/statistics/bootstrap.h). Of success,
where there are fewer than 5 objects or all change alike, it is Newcombe's of the pairs
(core/statistics/proportion.h) and speaks for these objects alone. Where all compared trials
succeed, or all fail, success cannot be decided, and there is none. */

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/statistics/answer.h"
#include "core/statistics/proportion.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Trials of a session under one of its conditions; none: as it is configured. */
struct ComparedSide {
  const Session* session = nullptr;
  std::optional<std::string> condition = {};
};

/** The planned grasp, or what the camera chose in its place (TrialResult::sight_grasp). */
std::string FindUsedGrasp(const TrialRecord& record);

/** One draw on every side; null: nothing is planned, or not finished. */
struct ComparedDraw {
  std::string hand, object;
  std::vector<const PlannedTrial*> planned;
  std::vector<const TrialRecord*> records;

  /** Two planned trials of these sides have other grasps. @pre both are planned. */
  bool ChangesGrasp(size_t side, size_t other) const {
    return planned[side]->grasp != planned[other]->grasp;
  }
};

/** In the order of the plans. @param is_any_hand  hands are what is compared: each
side has one. @pre sessions and records outlive the draws. */
std::vector<ComparedDraw> ListComparedDraws(const std::vector<ComparedSide>& sides,
                                            bool is_any_hand = false);

/** How many trials and successes there are. */
struct OutcomeCounts {
  int num_finished = 0, num_successes = 0;
};
OutcomeCounts CountOutcomes(const std::set<const TrialRecord*>& records);

/** "cannot decide success: all 12 trials succeed"; empty: both outcomes are among the compared.
@param left_out  finished trials of the same conditions that are not compared. */
std::string ExplainUndecided(const OutcomeCounts& compared, const OutcomeCounts& left_out = {});

/** Differences of one measure by object, a value for each draw. */
using ObjectChanges = std::map<std::string, std::vector<double>>;

struct ChangeEstimate {
  int num_draws = 0, num_objects = 0;
  double estimate = kUnset;
  Answer<Interval> interval = NoAnswer{"no draw has every value"};
  bool is_of_these_objects = false;  ///< the interval says nothing of other objects
};

ChangeEstimate EstimateChange(const ObjectChanges& changes);
/** @param pairs  of which the changes are the differences; none: they are of several pairs each.
@param undecided  ExplainUndecided of the trials. */
ChangeEstimate EstimateSuccessChange(const ObjectChanges& changes,
                                     const std::optional<PairedCounts>& pairs,
                                     const std::string& undecided);

/** "2 not finished, 1 without a value": counts with what they count, the empty ones left out. */
std::string DescribeCounts(const std::vector<std::pair<int, std::string>>& counts);

}  // namespace graspbench
