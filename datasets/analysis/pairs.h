#pragma once
/** @file
Pairs trials of the same draws under two conditions or in two sessions and estimates the change
between them. Sweeps, sensitivity, delays, numerics and comparisons of sessions all use these
functions, so that one question has one answer.

A draw is one hand, object and trial number, with the object in the identical pose. Its trials are
compared regardless of their grasps, unless one of the sides uses several grasps on the object: then
they are compared grasp by grasp. Trials without a partner are counted.

The change of a measure is the mean of its differences over the draws. Draws of one object are
alike, so the 95 % interval comes from resampling objects (core/statistics/bootstrap.h). For success
with fewer than 5 objects, or with the same change on all, it is Newcombe's interval of the pairs
(core/statistics/proportion.h), which is valid for these objects only. Where all compared trials
succeed, or all fail, there is no interval for success. */

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/statistics/answer.h"
#include "core/statistics/proportion.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Trials of a session under one of its conditions; none: the base. */
struct ComparedSide {
  const Session* session = nullptr;
  std::optional<std::string> condition = {};
  std::optional<std::string> hand = {};  ///< only of this hand
};

/** Returns the planned grasp, or the one that the camera chose (TrialResult::sight_grasp). */
std::string FindUsedGrasp(const TrialRecord& record);

/** One draw on every side; null: not planned, or not finished. */
struct ComparedDraw {
  std::string hand, object;
  std::vector<const PlannedTrial*> planned;
  std::vector<const TrialRecord*> records;

  /** Whether the planned trials of two sides have different grasps. @pre both are planned. */
  bool ChangesGrasp(size_t side, size_t other) const {
    return planned[side]->grasp != planned[other]->grasp;
  }
};

/** Lists the draws in the order of the plans. @pre sessions and records outlive the draws.
@param is_any_hand  pairs trials of different hands, which are what is compared: each side has
one. */
std::vector<ComparedDraw> ListComparedDraws(const std::vector<ComparedSide>& sides,
                                            bool is_any_hand = false);

/** Number of finished trials and of successes. */
struct OutcomeCounts {
  int num_finished = 0, num_successes = 0;
};
OutcomeCounts CountOutcomes(const std::set<const TrialRecord*>& records);

/** Returns "success not testable: all 12 trials succeed"; empty if the compared trials have both
outcomes. @param left_out  finished trials of the same conditions that are not compared. */
std::string ExplainUndecided(const OutcomeCounts& compared, const OutcomeCounts& left_out = {});

/** Differences of one measure, one value per draw, by object. */
using ObjectChanges = std::map<std::string, std::vector<double>>;

struct ChangeEstimate {
  int num_draws = 0, num_objects = 0;
  double estimate = kUnset;
  Answer<Interval> interval = NoAnswer{"no draw has every value"};
  bool is_of_these_objects = false;  ///< the interval is valid for these objects only
};

ChangeEstimate EstimateChange(const ObjectChanges& changes);
/** @param pairs  whose differences are the changes; none: each change combines several pairs.
@param undecided  result of ExplainUndecided for the trials. */
ChangeEstimate EstimateSuccessChange(const ObjectChanges& changes,
                                     const std::optional<PairedCounts>& pairs,
                                     const std::string& undecided);

/** Formats counts with what they count, without zeros: "2 not finished, 1 without a value". */
std::string DescribeCounts(const std::vector<std::pair<int, std::string>>& counts);

}  // namespace graspbench
