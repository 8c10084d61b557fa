#include "datasets/analysis/map/simultaneity_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/datasets/analysis/map/made_pairs.h"

namespace graspbench {

namespace {

const MapCell& Find(const SimultaneityMap& map, MapMeasure measure,
                    const std::vector<MapLevel>& where = {}) {
  return *FindCell(map, measure, "tum", LateDigit::kLast, where);
}

// By hand: 0.1 (0.1 (y1 - y0) + 0.3 (y3 - y0)) / (0.01 + 0.09).
TEST(SimultaneityMap, EffectsAreSlopesThroughTheTrialWithoutDelay) {
  const MapData data = MakeData(10, [](int, int, double delay) {
    return Values{delay == 0.3 ? 0.0 : 1.0, 1.0 + 2.0 * delay, kUnset, 4.0 - delay};
  });
  const SimultaneityMap map = MapSimultaneity(data);
  EXPECT_NEAR(Find(map, MapMeasure::kSuccess).estimate, -0.3, 1e-12);
  EXPECT_NEAR(Find(map, MapMeasure::kThreshold).estimate, 0.2, 1e-12);
  EXPECT_NEAR(Find(map, MapMeasure::kBreakingForce).estimate, -0.1, 1e-12);
  EXPECT_EQ(FindCell(map, MapMeasure::kPush, "tum", LateDigit::kLast, {}), nullptr);
  EXPECT_EQ(Find(map, MapMeasure::kSuccess).num_pairs, 40);
  EXPECT_EQ(Find(map, MapMeasure::kSuccess).num_objects, 10);
  EXPECT_EQ(Find(map, MapMeasure::kSuccess).changed,
            (std::vector<std::string>{"object0:0", "object0:1", "object0:2"}));
}

// A digit that never touches is the farthest push, and no farther than another that never does.
TEST(SimultaneityMap, NeverTouchedIsTheWorstRankOfThePush) {
  const MapData data = MakeData(6, [](int object, int, double delay) {
    if (object == 0) return Values{kUnset, kUnset, INFINITY, kUnset};
    if (object == 1) return Values{kUnset, kUnset, delay == 0.0 ? INFINITY : 0.01, kUnset};
    return Values{kUnset, kUnset, delay == 0.3 ? INFINITY : 0.01 + delay, kUnset};
  });
  const MapCell& cell = Find(MapSimultaneity(data), MapMeasure::kPush);
  EXPECT_EQ(cell.num_pairs, 24);
  EXPECT_NEAR(cell.estimate, (0.0 - 1.0 + 4.0) / 6.0, 1e-12);
}

TEST(SimultaneityMap, ALevelHoldsItsOwnPairs) {
  const MapData data = MakeData(50, [](int object, int draw, double delay) {
    const bool is_lost = draw % 2 == 0 && delay > 0.0;
    return Values{is_lost || object >= 45 ? 0.0 : 1.0, kUnset, kUnset, kUnset};
  });
  const SimultaneityMap map = MapSimultaneity(data);
  const MapCell& weak = Find(map, MapMeasure::kSuccess, {{0, 0}});
  const MapCell& firm = Find(map, MapMeasure::kSuccess, {{0, 1}});
  EXPECT_EQ(weak.verdict, MapVerdict::kCosts);
  EXPECT_EQ(NameWhere(map, weak), "grip weak");
  EXPECT_EQ(firm.estimate, 0.0);
  EXPECT_EQ(firm.verdict, MapVerdict::kNone);
  EXPECT_NEAR(firm.undelayed, 0.9, 1e-12);
}

TEST(SimultaneityMap, NothingIsSaidAtTheCeilingOrAtTheFloor) {
  for (const double success : {0.0, 1.0}) {
    const MapData data = MakeData(40, [&](int, int, double) {
      return Values{success, kUnset, kUnset, kUnset};
    });
    EXPECT_EQ(Find(MapSimultaneity(data), MapMeasure::kSuccess).verdict,
              success == 0.0 ? MapVerdict::kFloor : MapVerdict::kCeiling);
  }
}

// Half of the objects lose all, half gain all: the mean is zero and the interval wide.
TEST(SimultaneityMap, WhatTheIntervalLeavesOpenIsUndecided) {
  const MapData data = MakeData(20, [](int object, int, double delay) {
    const bool is_lost = (object % 2 == 0) == (delay > 0.0);
    return Values{is_lost ? 0.0 : 1.0, kUnset, kUnset, kUnset};
  });
  const MapCell& cell = Find(MapSimultaneity(data), MapMeasure::kSuccess);
  EXPECT_NEAR(cell.estimate, 0.0, 1e-12);
  EXPECT_EQ(cell.verdict, MapVerdict::kUndecided);
  EXPECT_GT(cell.num_objects_to_decide, 20);
}

// Of 20 pairs none changed: by Wilson's interval up to 3.84 / 23.84 of such pairs may, each by
// 0.1 (0.1 + 0.3) / (0.01 + 0.09) = 0.4.
TEST(SimultaneityMap, FewPairsWithoutChangeSayLittle) {
  const MapData data = MakeData(5, [](int object, int, double) {
    return Values{object == 0 ? 0.0 : 1.0, kUnset, kUnset, kUnset};
  });
  const MapCell& cell = Find(MapSimultaneity(data), MapMeasure::kSuccess);
  ASSERT_TRUE(cell.interval);
  EXPECT_NEAR(cell.interval->high, 0.4 * 3.8415 / 23.8415, 1e-4);
  EXPECT_NEAR(cell.interval->low, -cell.interval->high, 1e-12);
  EXPECT_EQ(cell.verdict, MapVerdict::kUndecided);
}

// Of each object one draw is pushed farther and one less far by any delay.
TEST(SimultaneityMap, ChangesThatCancelAreNotTakenForNone) {
  const MapData data = MakeData(30, [](int, int draw, double delay) {
    return Values{kUnset, kUnset, 1.0 + (draw < 2 ? delay : -delay), kUnset};
  });
  const MapCell& cell = Find(MapSimultaneity(data), MapMeasure::kPush);
  EXPECT_EQ(cell.estimate, 0.0);
  EXPECT_EQ(cell.verdict, MapVerdict::kUndecided);
}

TEST(SimultaneityMap, FewerThanFiveObjectsHaveNoInterval) {
  const MapData data = MakeData(4, [](int, int, double delay) {
    return Values{delay > 0.0 ? 0.0 : 1.0, kUnset, kUnset, kUnset};
  });
  const MapCell& cell = Find(MapSimultaneity(data), MapMeasure::kSuccess);
  EXPECT_FALSE(cell.interval);
  EXPECT_EQ(cell.verdict, MapVerdict::kUndecided);
}

TEST(SimultaneityMap, APairNeedsItsTrialWithoutDelay) {
  MapData data = MakeData(6, [](int, int, double delay) {
    return Values{delay > 0.0 ? 0.0 : 1.0, kUnset, kUnset, kUnset};
  });
  data.trials.erase(data.trials.begin());
  EXPECT_EQ(Find(MapSimultaneity(data), MapMeasure::kSuccess).num_pairs, 23);
}

// What holds everywhere is asked of two late digits only; its regions do not dilute it.
TEST(SimultaneityMap, EverywhereIsAFamilyOfItsOwn) {
  const SimultaneityMap map = MapSimultaneity(MakeData(10, [](int object, int, double delay) {
    return Values{delay == 0.3 && object > 1 ? 0.0 : 1.0, kUnset, kUnset, kUnset};
  }));
  const MapCell& everywhere = Find(map, MapMeasure::kSuccess);
  EXPECT_DOUBLE_EQ(everywhere.adjusted_p, everywhere.p) << "one hand, one late digit";
  EXPECT_GE(Find(map, MapMeasure::kSuccess, {{0, 0}}).adjusted_p, everywhere.p);
}

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

// Object 1 loses every second draw with 0.3 s, object 0 nothing: -0.3 in two of four pairs.
MapData MakeOneThatMatters() {
  return MakeData(2, [](int object, int draw, double delay) {
    return Values{object == 1 && draw % 2 == 0 && delay == 0.3 ? 0.0 : 1.0, kUnset, kUnset, kUnset};
  });
}

TEST(ObjectEffects, TheLargestLossComesFirstWithItsRates) {
  const std::vector<ObjectEffect> effects = ListObjectEffects(MakeOneThatMatters());
  ASSERT_EQ(effects.size(), 2u);
  EXPECT_EQ(effects[0].object, "object1");
  EXPECT_NEAR(effects[0].estimate, -0.15, 1e-12);
  ASSERT_EQ(effects[0].rates.size(), 3u);
  EXPECT_DOUBLE_EQ(effects[0].rates[0].rate, 1.0);
  EXPECT_DOUBLE_EQ(effects[0].rates[2].delay, 0.3);
  EXPECT_DOUBLE_EQ(effects[0].rates[2].rate, 0.5);
  EXPECT_FALSE(effects[0].interval) << "four pairs are too few";
  EXPECT_DOUBLE_EQ(effects[1].estimate, 0.0);
  EXPECT_EQ(effects[0].changed, (std::vector<std::string>{"object1:0", "object1:2"}));
  EXPECT_TRUE(effects[1].changed.empty());
}

// Twelve draws of an object, nine of them lost: the interval excludes 0.
TEST(ObjectEffects, AreSaidWithTheirRatesWhereTheIntervalExcludesZero) {
  MapData data;
  data.factors = {{"grip", {"weak", "firm"}}};
  for (int draw = 0; draw < 12; ++draw) {
    for (const double delay : {0.0, 0.3}) {
      const double value = delay > 0.0 && draw % 4 != 0 ? 0.0 : 1.0;
      data.trials.push_back(MakeTrial(0, draw, delay > 0.0 ? LateDigit::kLast : LateDigit::kNone,
                                      delay, {value, kUnset, kUnset, kUnset}));
    }
  }
  const std::vector<ObjectEffect> effects = ListObjectEffects(data);
  ASSERT_EQ(effects.size(), 1u);
  ASSERT_TRUE(effects[0].interval);
  EXPECT_LT(effects[0].interval->high, 0.0);
  const std::string says = DescribeObjects(effects, "tum");
  EXPECT_NE(says.find("lowers success on 1 of 1 object and raises it on 0 ("), std::string::npos)
      << says;
  EXPECT_NE(says.find("object0 100 to 25 %"), std::string::npos) << says;
  EXPECT_EQ(DescribeObjects(effects, "shadow"), "");
}

}  // namespace

}  // namespace graspbench
