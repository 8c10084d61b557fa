#pragma once
/** @file
A map of simultaneity for a terminal: what it finds of each hand, then its levels. */

#include <string>

#include "datasets/analysis/map/map_result.h"

namespace graspbench {

/** Of the last digit; the first's and every two levels are in map.csv and the report. */
std::string FormatMap(const MapResult& result);

}  // namespace graspbench
