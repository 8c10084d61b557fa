#pragma once
/** @file
The argument of the thesis (Roethling, Bielefeld 2007) as claims that a campaign's trials support or
refute. Each verdict follows from one number's 95 % interval by a rule fixed before the campaign
ran:

    claim                                             holds             does not hold
    good grasps touch simultaneously                  never decided by a campaign, which gives
                                                      only correlations
    a pre-grasp can be learned for it                 median GFT% over scenes, step 1:
                                                      factor below 1    factor above 1
    the thumb's target decides how firmly it holds    breaking force over grip, step 2:
                                                      factor above 1    factor below 1
    optimised grasps are better                       breaking force, both steps:
                                                      factor above 1    factor below 1, or success
                                                      and success no    significantly lower
                                                      5 points lower
    they hold better with the same grip               breaking force over grip, both steps:
                                                      factor above 1    factor below 1
    sigma predicts the breaking force                 share of the scenes with a new target in
                                                      which both change in the same direction:
                                                      above 1/2         below 1/2

Claims about steps, which have factors, are also judged for each hand: what holds for one of two
hands has not been shown for very different ones. Fewer than five scenes decide nothing, nor does a
correlation: late contacts and failures may both result from the object's pose. Experiments that
delay a digit on the same draws decide (simultaneity_map.h). Whether people strive for simultaneous
contacts cannot be tested on robots (human_study). Everything else is not decided. Rules and limits
are proposed by graspbench. */

#include <array>
#include <map>
#include <string>
#include <vector>

#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
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

/** A number on which a verdict is based. */
struct ClaimEvidence {
  std::string hand;       ///< id; empty: all hands
  std::string what;       ///< "GFT% with success"
  double value = kUnset;  ///< NaN: none
  Interval interval = {kUnset, kUnset};
  std::string counted;  ///< "12 scenes"
};

struct ThesisClaim {
  const char* id;        ///< "simultaneous"
  const char* topic;     ///< label in a figure
  const char* sentence;  ///< the claim
  const char* design;    ///< design of the experiment behind the evidence
  const char* decides;   ///< what would decide it if it is not decided
  double neutral;        ///< the null value
  std::vector<ClaimEvidence> evidence;
  ClaimVerdict verdict = ClaimVerdict::kNotDecided;
};

/** Judges the claims, in the order of the argument. */
std::vector<ThesisClaim> JudgeThesis(const Campaign& campaign,
                                     const std::vector<SceneVariants>& scenes);

/** Counts paired successes of two variants on the same draws, over the scenes of the hand; an empty
hand means all. */
PairedCounts CountPairedSuccesses(const std::vector<SceneVariants>& scenes, Variant a, Variant b,
                                  const std::string& hand = {});

/* Details of a cell's trials: which digit touched first, the lag between two fingers, and the
thumb's position in the closed grasp. Means are over the trials in which they are defined. */

/** Mean absolute lag between the first contacts of two digits [s]; NaN if both never touched in one
trial. */
double CalcContactGap(const CellSummary& cell, const std::string& digit_a,
                      const std::string& digit_b);

/** Number of trials in which each digit touched first, by its id; digits that never did are left
out. */
std::map<std::string, int> CountFirstTouches(const CellSummary& cell);

/** Digit that most often touched first, among equal ones the first by id; empty: none. */
std::string FindFirstDigit(const CellSummary& cell);

/** Position of the thumb's pad in the closed grasp, averaged over trials. */
struct ThumbPlace {
  double height = 0.0;          ///< above the object's lowest plane [m]
  double from_blade_deg = 0.0;  ///< horizontal angle from the object's nearest axis, 0..45
};
ThumbPlace CalcThumbPlace(const CellSummary& cell, const Hand& hand, const GraspObject& object);

/** The thesis's example of the adhesive tape with the TUM Hand, as reproduced by a scene. */
struct TapeCourse {
  std::array<double, kNumVariants> sigma{};  ///< mean [N]
  double gap_before = 0.0, gap_after = 0.0;  ///< index to middle finger, about step 1 [s]
  bool always_succeeds = false;              ///< all variants succeed in all trials
  bool index_is_first = false;               ///< index finger touches first in the standard grasp
  bool fingers_meet = false;                 ///< the lag is smaller after step 1
  bool is_much_firmer = false;               ///< step 1 increases sigma by at least half
  bool is_firmer_again = false;              ///< step 2 increases sigma
};
TapeCourse FindTapeCourse(const SceneVariants& scene);

/** The thesis's example of the toy propeller: the thumb's position under each variant. */
struct PropellerCourse {
  std::array<ThumbPlace, kNumVariants> places;
  bool starts_on_blade = false;       ///< pad above the cube on which the blades lie
  bool moves_between_blades = false;  ///< step 1 moves it away from a blade by more than 5 degrees
  bool ends_on_cube = false;          ///< pad at the cube's height after step 2
};
PropellerCourse FindPropellerCourse(const SceneVariants& scene, const Hand& hand,
                                    const GraspObject& object);

}  // namespace graspbench
