#pragma once
/** @file
A laboratory's trials (datasets/campaign/real_trials.h) beside the simulated ones of the same hand,
object and variant. Contacts count for the digits of the scene's grasp; a trial without all of them
or with one before the start of closure has no GFT%, as in the simulation. */

#include <string>
#include <vector>

#include "datasets/analysis/campaign/campaign_summary.h"

namespace graspbench {

struct RealCell {
  const SceneVariants* scene = nullptr;
  Variant variant = kStandardGrasp;
  Tally real;                      ///< only successes are known of their outcomes
  double success_p = kUnset;       ///< of "succeeds as often as in the simulation", Fisher
  std::vector<double> gft_ratios;  ///< of the trials that have it
  double median_gft_ratio() const;
};

/** What really happened of one variant over the scenes in which all were tried, and in the same
scenes in the simulation. */
struct RealTotal {
  Variant variant = kStandardGrasp;
  int num_scenes = 0;
  Tally real, simulated;
};

/** In how many scenes a step changes a measure the same way really and in the simulation, of those
where both change. */
struct RealAgreement {
  const char* step = "";     ///< "step 1"
  const char* measure = "";  ///< "GFT%"
  int num_scenes = 0, num_alike = 0;
  Interval share;  ///< Wilson
};

struct RealComparison {
  std::vector<RealCell> cells;  ///< in the order of scenes and variants
  std::vector<RealTotal> totals;
  std::vector<RealAgreement> agreements;
  int num_made_up = 0;    ///< trials whose note says so
  int num_unmatched = 0;  ///< of scenes that are not finished
};

RealComparison CompareWithReal(const std::vector<RealTrial>& real,
                               const std::vector<SceneVariants>& scenes);

}  // namespace graspbench
