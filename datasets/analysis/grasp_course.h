#pragma once
/** @file
How the trials of one cell came about: who touched first, how far apart two fingers came, where the
thumb stood in the closed grasp. Means are over the trials in which they are defined. */

#include <map>
#include <string>

#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "datasets/analysis/session_summary.h"

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

}  // namespace graspbench
