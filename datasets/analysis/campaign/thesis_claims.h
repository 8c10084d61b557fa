#pragma once
/** @file
The argument of the thesis (Roethling, Bielefeld 2007) as claims that a campaign's trials bear or do
not. Each verdict comes from one number's 95 % interval by a rule that was written before the
campaign ran:

    claim                                             holds             does not hold
    good grasps touch simultaneously                  by no campaign: its trials only go together
                                                      with what makes digits late
    a pre-grasp can be learned for it                 median GFT% over scenes, step 1:
                                                      factor below 1    factor above 1
    the thumb's target decides how firmly it holds    breaking force over grip, step 2:
                                                      factor above 1    factor below 1
    optimised grasps are better                       breaking force, both steps:
                                                      factor above 1    factor below 1, or success
                                                      and success no    lower for sure
                                                      5 points lower
    they hold better with the same grip               breaking force over grip, both steps:
                                                      factor above 1    factor below 1
    sigma says what breaks a grasp                    share of the scenes with a new target in
                                                      which sigma and breaking force change alike:
                                                      above 1/2         below 1/2

Factors, the claims of steps, are judged for each hand as well: what holds for one of two hands has
not been shown for very different ones. Fewer than five scenes decide nothing. A correlation decides
nothing either: that digits touch late and grasps fail may both come from where the object lay; the
same draws with a digit made late decide (simultaneity_map.h). That people strive for simultaneous
contacts cannot be asked of robots (human_study). Everything else is not decided.
Rules and limits are proposed by graspbench. */

#include <string>
#include <vector>

#include "datasets/analysis/campaign/campaign_summary.h"

namespace graspbench {

enum class ClaimVerdict { kHolds, kDoesNotHold, kNotDecided };
struct ClaimVerdictRow {
  ClaimVerdict value;
  const char* name;
};
inline constexpr ClaimVerdictRow kClaimVerdicts[] = {{ClaimVerdict::kHolds, "holds"},
                                                     {ClaimVerdict::kDoesNotHold, "does not hold"},
                                                     {ClaimVerdict::kNotDecided, "not decided"}};

/** A number that a verdict rests on. */
struct ClaimEvidence {
  std::string hand;       ///< id; empty: all hands
  std::string what;       ///< "GFT% with success"
  double value = kUnset;  ///< NaN: there is none
  Interval interval = {kUnset, kUnset};
  std::string counted;  ///< "12 scenes"
};

struct ThesisClaim {
  const char* id;        ///< "simultaneous"
  const char* topic;     ///< in a figure
  const char* sentence;  ///< what is claimed
  const char* design;    ///< how its evidence was got
  const char* decides;   ///< what would decide it where the verdict is that nothing does
  double neutral;        ///< a value that says neither
  std::vector<ClaimEvidence> evidence;
  ClaimVerdict verdict = ClaimVerdict::kNotDecided;
};

/** In the order of the argument. */
std::vector<ThesisClaim> JudgeThesis(const Campaign& campaign,
                                     const std::vector<SceneVariants>& scenes);

/** How often the same trial poses succeeded with both variants, over the scenes of the hand; an
empty hand means all. */
PairedCounts CountPairedSuccesses(const std::vector<SceneVariants>& scenes, Variant a, Variant b,
                                  const std::string& hand = {});

}  // namespace graspbench
