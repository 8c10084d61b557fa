#pragma once
/** @file
The trials of one session of a map (datasets/plan/map_design.h) as its analysis takes them. */

#include <vector>

#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/map/simultaneity_map.h"

namespace graspbench {

/** Trials that ended as numerical failures are left out: they say nothing of a grasp.
@param thresholds  LoadThresholds(session). */
MapData ListMapTrials(const Session& session, const std::vector<ThresholdSummary>& thresholds);

}  // namespace graspbench
