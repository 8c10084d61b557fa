#pragma once
/** @file
The page of a map of simultaneity: what it finds of each hand, a map for each measure, the regions
with the trials behind them, and what goes with success without delays. */

#include <string>

#include "datasets/analysis/map/map_result.h"

namespace graspbench {

/** A self-contained page like the session's report. */
std::string MakeMapPage(const Session& session, const MapResult& result);

}  // namespace graspbench
