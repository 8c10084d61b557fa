#pragma once
/** @file
GFT% of a variant's benchmark trials beside its floor (core/grasp/gft_floor.h): how much of it is
scatter from trial to trial, which no pre-grasp can take away. */

#include <string>
#include <vector>

#include "core/statistics/answer.h"
#include "datasets/analysis/campaign/campaign_summary.h"

namespace graspbench {

/** Of the same trials as a cell's GFT%: all of them. */
Answer<double> CalcGftFloorOf(const std::vector<const TrialRecord*>& records);

/** One variant over complete scenes that have both. */
struct GftFloors {
  int num_scenes = 0;
  double median_ratio = kUnset, median_floor = kUnset;  ///< of GFT% and of its floor
  int num_near = 0;                                     ///< scenes with GFT% <= 1.2 floor
  int num_without = 0;                                  ///< complete scenes without a floor
};
/** @param hand  empty: all hands. */
GftFloors CalcGftFloors(const std::vector<SceneVariants>& scenes, Variant variant,
                        const std::string& hand = {});

/** "new pre-grasp: GFT% 9.5 %, floor 7.1 % (medians); 12 of 40 scenes reach at most 1.2 times their
floor; 2 scenes without a floor". */
std::string DescribeGftFloors(const GftFloors& floors, Variant variant);

}  // namespace graspbench
