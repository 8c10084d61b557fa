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

/* How the trials of one cell came about: who touched first, how far apart two fingers came, where
the thumb stood in the closed grasp. Means are over the trials in which they are defined. */

/** Mean time between the first touches of two digits [s]; NaN when they never both touched. */
double CalcContactGap(const CellSummary& cell, const std::string& digit_a,
                      const std::string& digit_b);

/** In how many trials each digit touched first, by its id; digits that never did are left out. */
std::map<std::string, int> CountFirstTouches(const CellSummary& cell);

/** The digit that touched first most often, of equal ones the first by id; empty: none. */
std::string FindFirstDigit(const CellSummary& cell);

/** Where the pad of the thumb stands when the grasp is closed, the mean over trials. */
struct ThumbPlace {
  double height = 0.0;          ///< above the object's lowest plane [m]
  double from_blade_deg = 0.0;  ///< horizontal angle from the object's nearest axis, 0..45
};
ThumbPlace CalcThumbPlace(const CellSummary& cell, const Hand& hand, const GraspObject& object);

/** The course of the adhesive tape with the TUM Hand, as the thesis knows it. */
struct TapeCourse {
  std::array<double, kNumVariants> sigma{};  ///< mean [N]
  double gap_before = 0.0, gap_after = 0.0;  ///< index to middle finger, about step 1 [s]
  bool always_succeeds = false;              ///< every variant in every trial
  bool index_is_first = false;               ///< under the standard grasp
  bool fingers_meet = false;                 ///< the gap is smaller after step 1
  bool is_much_firmer = false;               ///< sigma by half or more after step 1
  bool is_firmer_again = false;              ///< after step 2
};
TapeCourse FindTapeCourse(const SceneVariants& scene);

/** The course of the toy propeller: where the thumb stands under each variant. */
struct PropellerCourse {
  std::array<ThumbPlace, kNumVariants> places;
  bool starts_on_blade = false;       ///< above the cube that the blades lie on
  bool moves_between_blades = false;  ///< step 1 turns it by more than 5 degrees from a blade
  bool ends_on_cube = false;          ///< after step 2
};
PropellerCourse FindPropellerCourse(const SceneVariants& scene, const Hand& hand,
                                    const GraspObject& object);

}  // namespace graspbench
