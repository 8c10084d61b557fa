#pragma once
/** @file
How finely a map of simultaneity resolves success. Of the regions (cells of one or two levels, first
and last digit) of a hand that have at least 150 pairs of 20 objects, with [l, h] the cell's 95 %
interval for 100 ms (simultaneity_map.h),

    half-width = (h - l) / 2, narrow: at most 0.05 (5 points of success)

The bar is graspbench's own: a late digit that costs 5 points for 100 ms is seen in a region, unless
the region is wide. */

#include <string>
#include <vector>

#include "datasets/analysis/map/simultaneity_map.h"

namespace graspbench {

inline constexpr int kPairsOfLargeRegion = 150, kObjectsOfLargeRegion = 20;
inline constexpr double kNarrowHalfWidth = 0.05;  ///< of a rate, for 100 ms

struct MapPrecision {
  int num_regions = 0;               ///< with pairs
  int num_large = 0;                 ///< of them with 150 pairs of 20 objects
  std::vector<const MapCell*> wide;  ///< of the large ones, the widest first
  int num_narrow() const { return num_large - static_cast<int>(wide.size()); }
};

/** Half of the interval's width; NaN without an interval. */
double CalcHalfWidth(const MapCell& cell);

/** The result points into `map`. A large region without an interval is wide. */
MapPrecision FindPrecision(const SimultaneityMap& map, const std::string& hand);

/** "Of 158 regions with at least 150 pairs of 20 objects, 150 have a 95 % interval with a half-width
of at most 5 points of success for 100 ms."; or that no region is so large. */
std::string DescribePrecision(const MapPrecision& precision);

}  // namespace graspbench
