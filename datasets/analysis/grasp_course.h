#pragma once
/** @file
How the trials of one cell came about: who touched first, how far apart two fingers came, where the
thumb stood in the closed grasp. Means are over the trials in which they are defined. */

#include <array>
#include <map>
#include <string>

#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "datasets/analysis/campaign/campaign_summary.h"

namespace graspbench {

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
