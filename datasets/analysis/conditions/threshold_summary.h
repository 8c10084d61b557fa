#pragma once
/** @file
Grip thresholds of a session's draws: what graspbench threshold has stored below thresholds/, a
session whose conditions are the grips of a scale (core/trial/grip/grip_threshold.h), of which only
those trials ran that the bisection of their draw asked for. Of a sweep they are the grips under its
base, then under each of its conditions, and each has its own threshold of a draw.

A cell's threshold is the median over its draws; a draw that no grip held counts as above every
other. Its interval is that of order statistics: of n sorted draws the k-th and the (n + 1 - k)-th
with the largest k for which each tail of the binomial distribution with 1/2 holds at most 2.5 %;
below 6 draws there is none (Conover 1999, Practical Nonparametric Statistics, 3.2). */

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/statistics/proportion.h"
#include "core/trial/grip/grip_threshold.h"
#include "datasets/plan/conditions.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** The grips of a scale as conditions of a session, from the least, of a sweep under its base and
under each of its conditions. Without a least force under margins, which would hide them; a session
that closes to its posture touches at the speed that a regulated grip has by default.
@throws Error(kUsage) for a sweep of the grip itself. */
std::vector<Condition> ListThresholdGrips(const ThresholdScale& scale, const SessionConfig& config);

struct DrawThreshold {
  PlannedTrial draw;                ///< the session's trial
  int most_place = kMostGripPlace;  ///< that was planned: no drive gives more
  GripThreshold found;
  double value = kUnset;  ///< margin, or force [N]; infinite: no grip held; NaN: it is not finished
};

struct CellThreshold {
  std::string condition;  ///< of a sweep; empty: the base
  std::string hand, object, grasp;
  int num_draws = 0;                   ///< finished
  int num_never = 0;                   ///< no grip that was asked held
  int num_below = 0;                   ///< held by the least
  std::vector<int> not_monotone;       ///< numbers of trials
  double median = kUnset;              ///< infinite: half of the draws or more never held
  double low = kUnset, high = kUnset;  ///< 95 % interval; NaN: too few draws

  /** The median takes in a draw that the least grip held: it may be lower. */
  bool is_at_most() const {
    return num_draws > 0 && 2 * num_below >= num_draws && std::isfinite(median);
  }
};

struct ThresholdSummary {
  const ThresholdScale* scale = nullptr;
  std::vector<DrawThreshold> draws;  ///< in the order of the plan
  std::vector<CellThreshold> cells;
  int num_trials = 0;  ///< that were asked for

  int num_not_monotone() const;
};

/** Of one experiment on the session's draws, in the order of the session's plan.
@throws Error(kFormat) when its conditions are no grips. */
ThresholdSummary SummariseThresholds(const Session& experiment, const Session& session);
/** Of the experiments in the session's folder, each scale once, with as many draws as are known.
@throws as LoadSession. */
std::vector<ThresholdSummary> LoadThresholds(const Session& session);

/** The draws that fail again with a larger grip: "draws 3, 7", "none". */
std::string NameNotMonotone(const CellThreshold& cell);

/** "no force above 3.15 N is asked of tum g1, whose drives give no more; ..."; empty: all are. */
std::string DescribeCeilings(const ThresholdSummary& summary);

/** "at most 1.09", "none held". */
std::string FormatMedian(const ThresholdScale& scale, const CellThreshold& cell);

/** Of the session's finished trials in their order; NaN where none was looked for. */
std::vector<double> ListThresholdsOf(const Session& session, const ThresholdSummary& summary);

/** The trials that the bisections of the draws ask for next, in the order of the plan. */
std::vector<PlannedTrial> FindThresholdTrials(const Session& experiment);

/** The 95 % interval of a median as above; none of fewer than six values. Infinite values keep their
place. @pre no NaN among them. */
std::optional<Interval> CalcMedianInterval(std::vector<double> values);

/** "1.19", "0.70 N", "none held"; "n/a" without a value. */
std::string FormatThreshold(const ThresholdScale& scale, double value);

/** export/thresholds.csv with a row for each draw; none without thresholds. */
std::vector<ExportTable> MakeThresholdTables(const std::vector<ThresholdSummary>& thresholds);

/** {scale, unit, cells: [..], draws, trials, not_monotone}; infinite and NaN are null. */
Json ToJson(const ThresholdSummary& summary);

}  // namespace graspbench
