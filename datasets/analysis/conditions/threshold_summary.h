#pragma once
/** @file
Grip thresholds of a session's draws: what graspbench threshold has stored below thresholds/, a
session whose conditions are the grips of a scale, of which only those trials ran that the bisection
of their draw asked for. Of a sweep they are the grips under its base, then under each of its
conditions, and each has its own threshold of a draw.

The grip threshold of a draw: the smallest grip, a margin or a force, with which its trial succeeds.
Found by bisection of the same draw over seventeen grips, equal steps of the logarithm from the
least to the largest of a scale:

    grip_k = least (most / least)^(k / 16),   k = 0 .. 16

First the largest grip, then four halvings, then one trial that asks halfway between threshold and
largest grip, where a draw that is not monotone may fail again, which bisection alone cannot see; or
the least grip, where none has failed. Where the largest grip fails, as of an object that is squeezed
out of the hand, weaker ones are asked, 8, 4, 2, then 12, until one holds: such a draw has a
threshold and is not monotone. So a threshold costs at most kMostThresholdTrials trials, and is the
smallest grip that was asked and held.

A cell's threshold is the median over its draws; a draw that no grip held counts as above every
other. Its interval is that of order statistics: of n sorted draws the k-th and the (n + 1 - k)-th
with the largest k for which each tail of the binomial distribution with 1/2 holds at most 2.5 %;
below 6 draws there is none (Conover 1999, Practical Nonparametric Statistics, 3.2). */

#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text/csv.h"
#include "core/grasp/strategy.h"
#include "core/statistics/proportion.h"
#include "datasets/plan/conditions.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** The grips of a scale as conditions of a session, from the least, of a sweep under its base and
under each of its conditions. Without a least force under margins, which would hide them; a session
that closes to its posture touches at the speed that a regulated grip has by default.
@throws Error(kUsage) for a sweep of the grip itself. */
std::vector<Condition> ListThresholdGrips(const ThresholdScale& scale, const SessionConfig& config);

/** Of forces that the hands' pads hardly give (datasets/plan/grip_check.h). */
std::vector<std::string> ListThresholdWarnings(const ThresholdScale& scale, SessionConfig config,
                                               const SessionInputs& inputs);

inline constexpr int kMostThresholdTrials = 6;

/** grip_k. @pre 0 <= place <= kMostGripPlace */
double CalcGripAt(const ThresholdScale& scale, int place);

struct GripThreshold {
  std::optional<int> place;     ///< none: no grip that was asked held
  bool is_below_range = false;  ///< it succeeds with the least grip: the threshold is no larger
  bool is_monotone = true;      ///< as far as was asked
  std::vector<int> failed, succeeded;  ///< places, in the order of asking
  std::optional<int> next;             ///< must be asked to go on; the threshold is not found yet
};

/** @param succeeds  a trial of the draw with the grip at this place; none: it is not known.
@param most  the largest place to ask, at least 0: no drive gives more. */
GripThreshold FindGripThreshold(const std::function<std::optional<bool>(int place)>& succeeds,
                                int most = kMostGripPlace);

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

/** The cells as people see them. */
ShownTable ShowCells(const ThresholdSummary& summary);

/** {scale, unit, cells: [..], draws, trials, not_monotone}; infinite and NaN are null. */
Json ToJson(const ThresholdSummary& summary);

}  // namespace graspbench
