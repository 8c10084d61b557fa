#include "datasets/analysis/map/map_precision.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

MapCell MakeRegion(int num_pairs, int num_objects, Answer<Interval> interval) {
  MapCell cell;
  cell.hand = "tum";
  cell.late = LateDigit::kLast;
  cell.where = {{0, 0}};
  cell.num_pairs = num_pairs;
  cell.num_objects = num_objects;
  cell.interval = interval;
  return cell;
}

TEST(MapPrecision, CountsLargeRegionsAndNamesTheWideOnes) {
  SimultaneityMap map;
  map.hands = {"tum"};
  map.factors = {{"grip", {"weak"}}};
  map.cells = {MakeRegion(150, 20, Interval{-0.1, 0.0}),   // 5 points: at the bar
               MakeRegion(400, 29, Interval{-0.02, 0.1}),  // 6 points
               MakeRegion(150, 20, Interval{-0.3, 0.0}),   // 15 points
               MakeRegion(149, 20, Interval{-0.3, 0.0}),   // too few pairs
               MakeRegion(150, 19, Interval{-0.3, 0.0}),   // too few objects
               MakeRegion(0, 0, NoAnswer{"no pair"})};
  MapCell other = MakeRegion(400, 29, Interval{-0.3, 0.0});
  other.measure = MapMeasure::kPush;
  map.cells.push_back(other);
  other = MakeRegion(400, 29, Interval{-0.3, 0.0});
  other.where.clear();  // everywhere is no region
  map.cells.push_back(other);
  const MapPrecision precision = FindPrecision(map, "tum");
  EXPECT_EQ(precision.num_regions, 5);
  EXPECT_EQ(precision.num_large, 3);
  EXPECT_EQ(precision.num_narrow(), 1);
  ASSERT_EQ(precision.wide.size(), 2u);
  EXPECT_DOUBLE_EQ(CalcHalfWidth(*precision.wide[0]), 0.15);
  EXPECT_DOUBLE_EQ(CalcHalfWidth(*precision.wide[1]), 0.06);
  EXPECT_EQ(DescribePrecision(precision),
            "Of 3 regions with at least 150 pairs of 20 objects, 1 have a 95 % interval with a "
            "half-width of at most 5 points of success for 100 ms.");
}

TEST(MapPrecision, WithoutLargeRegionsThatIsSaid) {
  SimultaneityMap map;
  map.cells = {MakeRegion(10, 5, Interval{0.0, 0.0})};
  EXPECT_EQ(DescribePrecision(FindPrecision(map, "tum")),
            "None of 1 region has at least 150 pairs of 20 objects.");
}

}  // namespace
}  // namespace graspbench
