#pragma once
/** @file
Share of the load mu N - m g, allowed by friction and grip at an object's sides, that the start and
the accepted grasp of step 2 carry (core/optimise/learning_trial.h). Scenes of a campaign record it
in the trials of step 2's check. */

#include <string>
#include <vector>

#include "core/statistics/answer.h"
#include "datasets/analysis/campaign/campaign_summary.h"
#include "datasets/campaign/campaign_store.h"

namespace graspbench {

struct SceneHeadroom {
  double start_share = kUnset, start_bound = kUnset;  ///< of mu N - m g; mu N - m g [N]
  double kept_share = kUnset, kept_bound = kUnset;    ///< those of the accepted grasp
};
/** Returns the scene's shares; no answer if step 2 was not run or no grasp held. */
Answer<SceneHeadroom> FindHeadroom(const SceneRecord& scene);

/** Medians of a hand over its scenes that have a share. */
struct Headrooms {
  std::string hand;
  int num_scenes = 0;
  double median_start = kUnset, median_kept = kUnset;
  int num_without = 0;
  std::string why_without;  ///< the reasons, each once
};
/** Lists headrooms in the order of the campaign's hands. */
std::vector<Headrooms> ListHeadrooms(const Campaign& campaign);

/** Describes a hand's headrooms in one sentence. */
std::string DescribeHeadrooms(const Headrooms& headrooms);

/* GFT% of a variant's benchmark trials and its floor (contact_timing.h): the part that is scatter
between trials, which no pre-grasp can remove. */

/** Computes the floor of GFT% from the same trials as a cell's GFT%, namely all. */
Answer<double> CalcGftFloorOf(const std::vector<const TrialRecord*>& records);

/** GFT% and floor of one variant over complete scenes that have a floor. */
struct GftFloors {
  int num_scenes = 0;
  double median_ratio = kUnset, median_floor = kUnset;  ///< of GFT% and of its floor
  int num_near = 0;                                     ///< scenes with GFT% <= 1.2 floor
  int num_without = 0;                                  ///< complete scenes without a floor
};
/** @param hand  empty: all hands. */
GftFloors CalcGftFloors(const std::vector<SceneVariants>& scenes, Variant variant,
                        const std::string& hand = {});

/** Returns "new pre-grasp: GFT% 9.5 %, floor 7.1 % (medians); 12 of 40 scenes reach at most 1.2
times their floor; 2 scenes without a floor". */
std::string DescribeGftFloors(const GftFloors& floors, Variant variant);

}  // namespace graspbench
