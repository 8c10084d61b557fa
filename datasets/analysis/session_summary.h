#pragma once
/** @file
Summary of a session's records, computed once for the terminal, JSON and the report.

A rate is always stored with its counts, so that it is never printed without n and its interval.
Time measures are summarised by median and range over the trials in which they are defined. A digit
that never touched leaves GCT and GFT of its trial undefined, not zero. A trial with a contact
before closure began is counted separately and in no time measure. Times of reseated trials are
summarised separately. Trials with a numerical failure count as failures and are left out of every
other figure. */

#include <array>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/grasp/contact_timing.h"
#include "core/statistics/proportion.h"
#include "core/statistics/summary.h"
#include "datasets/analysis/hand_differences.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Median and range of a sample; NaN if it is empty. */
struct Spread {
  static constexpr int kFew = 5;  ///< displays mark a median of fewer values
  int n = 0;
  double median = 0.0;
  double lowest = 0.0;
  double highest = 0.0;
};
/** Leaves out values that are not finite. */
Spread CalcSpread(std::vector<double> values);

/** Results of a group of trials: a cell, a hand or a grasp. */
struct Tally {
  int planned = 0;
  int finished = 0;                          ///< n of every rate
  std::array<int, kNumOutcomes> outcomes{};  ///< in the order of ListOutcomes()
  double worst_penetration = 0.0;            ///< [m]; NaN: no trial to judge by
  double worst_energy_residual = 0.0;        ///< largest absolute value [J]
  long num_steps = 0;
  long num_unconverged = 0;

  void Count(Outcome outcome);  ///< adds one finished trial
  int CountOf(Outcome outcome) const;
  int successes() const { return CountOf(Outcome::kSuccess); }
  double rate() const;             ///< of success; NaN without a finished trial
  Interval rate_interval() const;  ///< 95 %, Wilson
  /** Most frequent outcome except success. Among equally frequent ones "no contact", then the first
  in ListOutcomes(). */
  Outcome most_frequent_failure() const;
  bool is_faultless() const { return finished > 0 && successes() == finished; }
  double share_unconverged() const;  ///< of the steps; NaN without a step
};
void AddTally(const Tally& part, Tally& sum);

/** Return "9 of 10 trials (90.0 %, 95 % interval 59.6 to 98.2 %)" and the interval alone; see
core/statistics/proportion.h. */
std::string FormatRate(const Tally& tally);
std::string FormatRateInterval(const Tally& tally);

/** Time measures of a group of trials. */
struct ContactTimes {
  Spread gct, gft, got;         ///< [s]
  Spread gft_ratio, got_ratio;  ///< of GCT
};

/** One hand on one object with one grasp. */
struct CellSummary {
  std::string hand, object, grasp;  ///< ids
  std::string key;                  ///< id without blanks: "tum-can-g3"
  std::vector<const TrialRecord*> records;
  Tally tally;
  ContactTimes times;           ///< of trials that are not reseated (object_in_hand.h)
  ContactTimes reseated_times;  ///< of reseated trials
  int num_early = 0;            ///< trials with a contact before the start of closure
  /** Contact orders with their number of trials, most frequent first. */
  std::vector<std::pair<std::string, int>> orders;
};

struct SessionSummary {
  std::vector<CellSummary> cells;           ///< in the plan's order
  std::vector<std::string> hands;           ///< ids in the plan's order
  std::vector<std::string> objects;         ///< ids in the plan's order
  std::vector<std::string> grasps;          ///< ids, sorted
  std::vector<HandDifference> differences;  ///< of every two hands
  Tally total;
  /** Indices of cells by hand, object and grasp, for FindCell. */
  std::map<std::tuple<std::string, std::string, std::string>, size_t> places;

  /** Returns null if the plan has no such cell. */
  const CellSummary* FindCell(const std::string& hand, const std::string& object,
                              const std::string& grasp) const;
  /** Sums over the cells of this hand, or only those of `grasp` unless it is empty. */
  Tally TallyOf(const std::string& hand, const std::string& grasp = {}) const;
};

/** Spread of one digit's first contact over the cell's trials [s]; trials without one are left
out. */
Spread CalcContactSpread(const CellSummary& cell, const std::string& digit);

/** Returns the grasps that the camera chose in the cell's trials, most frequent first: "by-sight: 7
g3, 2 g1, 1 not seen". For a given grasp, returns its id. */
std::string DescribeGrasp(const CellSummary& cell);

/** Summarises a session, which must outlive the summary. */
SessionSummary SummariseSession(const Session& session);

/* GFT% and GOT% (core/grasp/contact_timing.h) of groups of trials, computed alike for robots and
people so that they are comparable. */

/** Ratios of a group of trials. */
struct TimingRatios {
  Answer<Summary> gft, got;
  int num_without_gft = 0;  ///< a digit never touched, or the closure took no time
};
TimingRatios SummariseTimings(const std::vector<ContactTiming>& timings);

/** A robot hand's trials with all grasps (empty name) or with one. */
struct TimingGroup {
  std::string hand, grasp;  ///< ids
  TimingRatios ratios;
};
/** Lists groups by hand in the plan's order: all grasps, then each; a hand with one grasp has only
that group. Numerical failures are left out. */
std::vector<TimingGroup> ListTimingGroups(const Session& session);

}  // namespace graspbench
