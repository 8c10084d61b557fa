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

}  // namespace
}  // namespace graspbench
