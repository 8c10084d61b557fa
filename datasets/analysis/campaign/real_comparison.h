#pragma once
/** @file
Compares a laboratory's trials (datasets/campaign/real_trials.h) with the simulated ones of the same
hand, object and variant. Only contacts of the digits in the scene's grasp count. As in the
simulation, a trial that lacks one of them, or has one before the start of closure, has no GFT%. */

#include <string>
#include <vector>

#include "datasets/analysis/campaign/campaign_summary.h"

namespace graspbench {

struct RealCell {
  const SceneVariants* scene = nullptr;
  Variant variant = kStandardGrasp;
  Tally real;                      ///< only success or failure is known, not the kind of failure
  double success_p = kUnset;       ///< Fisher's exact test of equal success real and simulated
  std::vector<double> gft_ratios;  ///< of trials that have it
  double median_gft_ratio() const;
};

/** Real and simulated results of one variant over the scenes in which all variants were
executed. */
struct RealTotal {
  Variant variant = kStandardGrasp;
  int num_scenes = 0;
  Tally real, simulated;
};

/** Number of scenes in which a step changes a measure in the same direction in reality and in
simulation, among those in which both change. */
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
  int num_made_up = 0;    ///< trials marked as synthetic in their note
  int num_unmatched = 0;  ///< trials whose scene is missing or not finished
};

RealComparison CompareWithReal(const std::vector<RealTrial>& real,
                               const std::vector<SceneVariants>& scenes);

}  // namespace graspbench
