#pragma once
/** @file
What a session's records say, counted once for the terminal, JSON and the report.

A rate is always kept with its counts, so that it is never printed without n and its interval. Time
measures are summarised by median and range over the trials in which they are defined: a digit that
never touched leaves GCT and GFT of its trial missing, not zero, and a trial in which one touched
before closure began is counted apart and in no time measure. Times of trials that ended in another
seat stand apart. Trials with a numerical failure
count as not successful and are left out of every other figure. */

#include <array>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/grasp/contact_timing.h"
#include "core/statistics/proportion.h"
#include "core/statistics/summary.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Median and range of a sample; NaN when it is empty. */
struct Spread {
  static constexpr int kFew = 5;  ///< a median of fewer is marked where it is shown
  int n = 0;
  double median = 0.0;
  double lowest = 0.0;
  double highest = 0.0;
};
/** Values that are not finite are left out. */
Spread CalcSpread(std::vector<double> values);

/** Results of some trials: of a cell, a hand, a grasp. */
struct Tally {
  int planned = 0;
  int finished = 0;                          ///< n of every rate
  std::array<int, kNumOutcomes> outcomes{};  ///< in the order of ListOutcomes()
  double worst_penetration = 0.0;            ///< [m]; NaN: no trial to judge by, as below
  double worst_energy_residual = 0.0;        ///< largest absolute value [J]
  long num_steps = 0;
  long num_unconverged = 0;

  void Count(Outcome outcome);  ///< of one more finished trial
  int CountOf(Outcome outcome) const;
  int successes() const { return CountOf(Outcome::kSuccess); }
  double rate() const;             ///< of success; NaN without a finished trial
  Interval rate_interval() const;  ///< 95 %, Wilson
  /** Of all outcomes but success; of equally many "no contact", then the first of ListOutcomes(). */
  Outcome most_frequent_failure() const;
  bool is_faultless() const { return finished > 0 && successes() == finished; }
  double share_unconverged() const;  ///< of the steps; NaN without a step
};
void AddTally(const Tally& part, Tally& sum);

/** "9 of 10 trials (90.0 %, 95 % interval 59.6 to 98.2 %)" and the interval alone; see
core/statistics/proportion.h. */
std::string FormatRate(const Tally& tally);
std::string FormatRateInterval(const Tally& tally);

/** Time measures of some trials. */
struct ContactTimes {
  Spread gct, gft, got;         ///< [s]
  Spread gft_ratio, got_ratio;  ///< of GCT
};

/** One hand on one object with one grasp. */
struct CellSummary {
  std::string hand, object, grasp;  ///< ids
  std::string key;                  ///< one plain word: "tum-can-g3"
  std::vector<const TrialRecord*> records;
  Tally tally;
  ContactTimes times;           ///< of the trials that are not reseated (object_in_hand.h)
  ContactTimes reseated_times;  ///< of those that are
  int num_early = 0;            ///< trials with a contact before the start of closure
  /** Orders of contact with their number of trials, most frequent first. */
  std::vector<std::pair<std::string, int>> orders;
};

struct SessionSummary {
  std::vector<CellSummary> cells;    ///< in the plan's order
  std::vector<std::string> hands;    ///< ids in the plan's order
  std::vector<std::string> objects;  ///< ids in the plan's order
  std::vector<std::string> grasps;   ///< ids, sorted
  Tally total;
  /** Of the cells by hand, object and grasp, for FindCell. */
  std::map<std::tuple<std::string, std::string, std::string>, size_t> places;

  /** Null when the plan has no such cell. */
  const CellSummary* FindCell(const std::string& hand, const std::string& object,
                              const std::string& grasp) const;
  /** Over the cells of this hand; `grasp` narrows it further unless empty. */
  Tally TallyOf(const std::string& hand, const std::string& grasp = {}) const;
};

/** First touches of one digit over the cell's trials [s]; those that never touched are left out. */
Spread CalcContactSpread(const CellSummary& cell, const std::string& digit);

/** "by-sight: 7 g3, 2 g1, 1 not seen" of what the camera chose in the cell's trials, most frequent
first; of a grasp that was given its id. */
std::string DescribeGrasp(const CellSummary& cell);

/** The summary points into `session`, which must outlive it. */
SessionSummary SummariseSession(const Session& session);

/* GFT% and GOT% (core/grasp/contact_timing.h) of groups of trials, of robots and people alike, so
that both stand side by side as the same numbers. */

/** Ratios of a group of trials. */
struct TimingRatios {
  Answer<Summary> gft, got;
  int num_without_gft = 0;  ///< a digit never touched, or the closure took no time
};
TimingRatios SummariseTimings(const std::vector<ContactTiming>& timings);

/** A robot's trials of one hand: of all grasps (empty name) or one. */
struct TimingGroup {
  std::string hand, grasp;  ///< ids
  TimingRatios ratios;
};
/** By hand in the plan's order: all grasps, then each; a hand with one grasp has that alone. Trials
that failed numerically are left out. */
std::vector<TimingGroup> ListTimingGroups(const Session& session);

}  // namespace graspbench
