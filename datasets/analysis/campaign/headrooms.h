#pragma once
/** @file
How much of what friction and grip allow by an object's sides step 2 started from and what it kept
(core/optimise/learning_trial.h), as the scenes of a campaign recorded it in the trials of its
check. */

#include <string>
#include <vector>

#include "core/statistics/answer.h"
#include "datasets/analysis/campaign/campaign_summary.h"
#include "datasets/campaign/campaign_store.h"

namespace graspbench {

struct SceneHeadroom {
  double start_share = kUnset, start_bound = kUnset;  ///< of mu N - m g; mu N - m g [N]
  double kept_share = kUnset, kept_bound = kUnset;    ///< those of the start where it was kept
};
/** No answer: step 2 was not run, or nothing held. */
Answer<SceneHeadroom> FindHeadroom(const SceneRecord& scene);

/** Of one hand: medians over its scenes that have one. */
struct Headrooms {
  std::string hand;
  int num_scenes = 0;
  double median_start = kUnset, median_kept = kUnset;
  int num_without = 0;
  std::string why_without;  ///< their reasons, each once
};
/** In the order of the campaign's hands. */
std::vector<Headrooms> ListHeadrooms(const Campaign& campaign);

/** "step 2 starts from grasps that bear 0.81 of what friction and grip allow by an object's sides
and keeps grasps that bear 0.84 (medians of 21 scenes): ..." */
std::string DescribeHeadrooms(const Headrooms& headrooms);

/* GFT% of a variant's benchmark trials beside its floor (contact_timing.h): how much of it is
scatter from trial to trial, which no pre-grasp can take away. */

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
