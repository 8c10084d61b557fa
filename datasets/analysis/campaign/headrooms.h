#pragma once
/** @file
How much of what friction and grip allow by an object's sides step 2 started from and what it kept
(core/optimise/headroom.h), as the scenes of a campaign recorded it in the trials of its check. */

#include <string>
#include <vector>

#include "core/statistics/answer.h"
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

}  // namespace graspbench
