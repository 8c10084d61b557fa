#include "datasets/analysis/map/object_effects.h"

#include <gtest/gtest.h>

#include "tests/datasets/analysis/map/made_pairs.h"

namespace graspbench {
namespace {

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
  EXPECT_NE(says.find("costs 1 of 1 object success"), std::string::npos) << says;
  EXPECT_NE(says.find("object0 100 to 25 %"), std::string::npos) << says;
  EXPECT_EQ(DescribeObjects(effects, "shadow"), "");
}

}  // namespace
}  // namespace graspbench
