#include "datasets/analysis/map/map_pairs.h"

#include <gtest/gtest.h>

#include "tests/datasets/analysis/map/made_pairs.h"

namespace graspbench {
namespace {

TEST(MapPairs, HoldWhatEachDelayGave) {
  const MapData data = MakeData(1, [](int, int draw, double delay) {
    return Values{delay == 0.3 && draw == 2 ? 0.0 : 1.0, kUnset, kUnset, kUnset};
  });
  const std::vector<MapPair> pairs =
      ListMapPairs(data, "tum", LateDigit::kLast, MapMeasure::kSuccess);
  ASSERT_EQ(pairs.size(), 4u);
  for (const MapPair& pair : pairs) {
    ASSERT_EQ(pair.delayed.size(), 2u);
    EXPECT_EQ(pair.changed.empty(), pair.delayed[1].second == pair.undelayed);
  }
  EXPECT_TRUE(ListMapPairs(data, "shadow", LateDigit::kLast, MapMeasure::kSuccess).empty());
  EXPECT_TRUE(ListMapPairs(data, "tum", LateDigit::kFirst, MapMeasure::kSuccess).empty());
  EXPECT_TRUE(ListMapPairs(data, "tum", LateDigit::kLast, MapMeasure::kThreshold).empty());
}

}  // namespace
}  // namespace graspbench
