#pragma once
/** @file
What judged grasps say: how many pass under each profile, how far the files' own verdicts agree, how
verdicts change from profile to profile, and what nearly passed or failed.

Agreement beyond chance: Cohen's kappa = (p_o - p_e) / (1 - p_e), p_o the share of equal verdicts and
p_e that of two judges who pass as often, independently (J. Cohen, Educ. Psychol. Meas. 20, 1960).
Grasps whose simulation gave up fail, and are counted. */

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/statistics/proportion.h"
#include "datasets/judged_grasps/grasp_store.h"

namespace graspbench {

/** NaN where both always say the same. */
double CalcKappa(const PairedCounts& counts);

struct ProfileSummary {
  std::string profile;
  int num_judged = 0, num_passed = 0, num_numerical = 0;
  PairedCounts labels;  ///< of the grasps with one: first the label, second the verdict
  std::vector<std::pair<std::string, int>> stages;  ///< where grasps failed, most first
  /** Of grasps that passed undisturbed: the share of their disturbances that passes, too; NaN: none
  were asked for. */
  double jitter_share = kUnset;
};

/** The same grasps under two profiles. */
struct ProfileTransition {
  std::string from, to;
  PairedCounts counts;
};

struct JudgedSummary {
  int num_grasps = 0;  ///< without disturbances
  std::vector<ProfileSummary> profiles;
  std::vector<ProfileTransition> transitions;  ///< of each profile to the next
  /** Undisturbed, nearest to the limits first: see CalcMargin. */
  std::vector<const JudgedGrasp*> nearest;
};

/** How far from the border of pass and fail: the larger share of shift and turn that a pass used is
below 1, of a failure above it; the distance of its logarithm from 0. Infinite where a grasp failed
before it was tested. */
double CalcMargin(const JudgedGrasp& judged, double max_shift, double max_turn_deg);

/** @param judged  outlives the summary. @param limits  of each profile: shift [m], turn [deg]. */
JudgedSummary SummariseJudged(const std::vector<JudgedGrasp>& judged,
                              const std::map<std::string, std::pair<double, double>>& limits);

/** The limits of the profiles in a frozen configuration. @throws Error(kFormat). */
std::map<std::string, std::pair<double, double>> FindLimits(const Json& config);

}  // namespace graspbench
