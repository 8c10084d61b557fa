#include "datasets/analysis/map/map_precision.h"

#include <algorithm>

#include "core/base/text/text.h"

namespace graspbench {

double CalcHalfWidth(const MapCell& cell) {
  return cell.interval ? 0.5 * (cell.interval->high - cell.interval->low) : kUnset;
}

MapPrecision FindPrecision(const SimultaneityMap& map, const std::string& hand) {
  MapPrecision precision;
  for (const MapCell& cell : map.cells) {
    if (cell.hand != hand || cell.measure != MapMeasure::kSuccess) continue;
    if (cell.where.empty() || cell.num_pairs == 0) continue;
    ++precision.num_regions;
    if (cell.num_pairs < kPairsOfLargeRegion || cell.num_objects < kObjectsOfLargeRegion) continue;
    ++precision.num_large;
    if (!(CalcHalfWidth(cell) <= kNarrowHalfWidth)) precision.wide.push_back(&cell);
  }
  std::stable_sort(
      precision.wide.begin(), precision.wide.end(),
      [](const MapCell* a, const MapCell* b) { return CalcHalfWidth(*a) > CalcHalfWidth(*b); });
  return precision;
}

std::string DescribePrecision(const MapPrecision& precision) {
  const std::string size = "at least " + std::to_string(kPairsOfLargeRegion) + " pairs of " +
                           std::to_string(kObjectsOfLargeRegion) + " objects";
  if (precision.num_large == 0) {
    return "None of " + FormatCount(precision.num_regions, "region") + " has " + size + ".";
  }
  return "Of " + FormatCount(precision.num_large, "region") + " with " + size + ", " +
         std::to_string(precision.num_narrow()) +
         " have a 95 % interval with a half-width of at most " +
         FormatFixed(100.0 * kNarrowHalfWidth, 0) + " points of success for 100 ms.";
}

}  // namespace graspbench
