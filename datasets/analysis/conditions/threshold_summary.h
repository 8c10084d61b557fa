#pragma once
/** @file
Grip thresholds of a session's draws, from the experiments of `graspbench threshold` in the folder
thresholds/. Such an experiment is a session whose conditions are the grips of a scale; only trials
that the bisection of their draw required have run. For a sweep the conditions are the grips under
its base, then under each of its conditions, and a draw has a separate threshold under each.

The grip threshold of a draw is the smallest grip, a margin or a force, with which its trial
succeeds. It is found by bisection over seventeen grips, in equal logarithmic steps from the least
to the largest of a scale:

    grip_k = least (most / least)^(k / 16),   k = 0 .. 16

The largest grip is simulated first, then four bisections follow. A last trial halfway between
threshold and largest grip reveals draws that are not monotone and fail there, which bisection
cannot detect; if no grip has failed, the least grip is simulated instead. If the largest grip
fails, as when the object is squeezed out of the hand, weaker grips (k = 8, 4, 2, then 12) are
simulated until one holds: such a draw has a threshold and is not monotone. So a threshold costs at
most kMostThresholdTrials trials, and is the smallest simulated grip that held.

A cell's threshold is the median over its draws; a draw that no grip held counts as above every
other. Its interval is that of order statistics: the k-th and the (n + 1 - k)-th of n sorted draws,
with the largest k for which each tail of the binomial distribution with p = 1/2 has at most 2.5 %.
With fewer than 6 draws there is none (Conover 1999, Practical Nonparametric Statistics, 3.2). */

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

/** Lists the grips of a scale, from the least, as conditions of a session; for a sweep, under its
base and under each of its conditions. On the margin scale the minimum force is at most 1 mN, so
that it does not hide the margin. A session that closes to its posture gets the touch speed that a
regulated grip has by default.
@throws Error(kUsage) for a sweep of the grip itself. */
std::vector<Condition> ListThresholdGrips(const ThresholdScale& scale, const SessionConfig& config);

/** Lists warnings about forces that the hands' pads hardly exert (datasets/plan/grip_check.h). */
std::vector<std::string> ListThresholdWarnings(const ThresholdScale& scale, SessionConfig config,
                                               const SessionInputs& inputs);

inline constexpr int kMostThresholdTrials = 6;

/** Returns grip_k for k = `place`. @pre 0 <= place <= kMostGripPlace. */
double CalcGripAt(const ThresholdScale& scale, int place);

struct GripThreshold {
  std::optional<int> place;            ///< k of the threshold; none: no simulated grip held
  bool is_below_range = false;         ///< least grip holds: an upper bound
  bool is_monotone = true;             ///< in the simulated trials
  std::vector<int> failed, succeeded;  ///< k in the order of simulation
  std::optional<int> next;             ///< k to simulate next; none: the search is complete
};

/** Runs the bisection as far as results are known.
@param succeeds  whether the draw succeeds with the grip at this place; none: not simulated yet.
@param most  largest place that the drives allow, at least 0. */
GripThreshold FindGripThreshold(const std::function<std::optional<bool>(int place)>& succeeds,
                                int most = kMostGripPlace);

struct DrawThreshold {
  PlannedTrial draw;                ///< the trial of the session
  int most_place = kMostGripPlace;  ///< largest planned k, limited by the drives
  GripThreshold found;
  double value = kUnset;  ///< margin, or force [N]; infinite: no grip held; NaN: not finished
};

struct CellThreshold {
  std::string condition;  ///< of a sweep; empty: the base
  std::string hand, object, grasp;
  int num_draws = 0;                   ///< finished
  int num_never = 0;                   ///< draws that no simulated grip held
  int num_below = 0;                   ///< draws that the least grip held
  std::vector<int> not_monotone;       ///< trial numbers
  double median = kUnset;              ///< infinite: half of the draws or more never held
  double low = kUnset, high = kUnset;  ///< 95 % interval; NaN: too few draws

  /** Whether the median is an upper bound: it involves a draw that the least grip held. */
  bool is_at_most() const {
    return num_draws > 0 && 2 * num_below >= num_draws && std::isfinite(median);
  }
};

struct ThresholdSummary {
  const ThresholdScale* scale = nullptr;
  std::vector<DrawThreshold> draws;  ///< in the order of the plan
  std::vector<CellThreshold> cells;
  int num_trials = 0;  ///< trials of the bisections so far

  int num_not_monotone() const;
};

/** Summarises one experiment on the session's draws, in the order of the session's plan.
@throws Error(kFormat) if its conditions are not grips of a scale. */
ThresholdSummary SummariseThresholds(const Session& experiment, const Session& session);
/** Loads the thresholds from the session's folder: for each scale the experiment with the most
finished draws. @throws as LoadSession. */
std::vector<ThresholdSummary> LoadThresholds(const Session& session);

/** Names the draws that fail with a larger grip: "draws 3, 7", "none". */
std::string NameNotMonotone(const CellThreshold& cell);

/** Returns "no force above 3.15 N is asked of tum g1, the limit of its drives; ..."; empty if the
whole scale is used. */
std::string DescribeCeilings(const ThresholdSummary& summary);

/** Returns "at most 1.09", "none held". */
std::string FormatMedian(const ThresholdScale& scale, const CellThreshold& cell);

/** Lists the thresholds of the session's finished trials in their order; NaN if not searched. */
std::vector<double> ListThresholdsOf(const Session& session, const ThresholdSummary& summary);

/** Lists the trials that the bisections need next, in the order of the plan. */
std::vector<PlannedTrial> FindThresholdTrials(const Session& experiment);

/** Returns the 95 % interval of a median as above; none for fewer than six values. Infinite values
are sorted as such. @pre no value is NaN. */
std::optional<Interval> CalcMedianInterval(std::vector<double> values);

/** Returns "1.19", "0.70 N", "none held"; "n/a" without a value. */
std::string FormatThreshold(const ThresholdScale& scale, double value);

/** Makes export/thresholds.csv with one row per draw; empty without thresholds. */
std::vector<ExportTable> MakeThresholdTables(const std::vector<ThresholdSummary>& thresholds);

/** Makes the displayed table of cells. */
ShownTable ShowCells(const ThresholdSummary& summary);

/** Writes {scale, unit, cells: [..], draws, trials, not_monotone}; infinite and NaN values are
null. */
Json ToJson(const ThresholdSummary& summary);

}  // namespace graspbench
