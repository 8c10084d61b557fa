#include "core/develop/development_warnings.h"

#include <gtest/gtest.h>

#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

DevelopedGrasp MakeDeveloped(int num_held, int num_shapes, int num_failed, int num_trials) {
  DevelopedGrasp developed;
  for (int k = 0; k < num_shapes; ++k) {
    developed.check.push_back({k < num_held ? Outcome::kSuccess : Outcome::kNoContact, 0.0});
  }
  developed.num_trials = num_trials;
  developed.num_numerical_failures = num_failed;
  return developed;
}

size_t CountWarnings(int num_held, int num_shapes, int num_failed, int num_trials) {
  return ListDevelopmentWarnings(Hand(),
                                 MakeDeveloped(num_held, num_shapes, num_failed, num_trials))
      .size();
}

TEST(DevelopmentWarnings, NamesWhatHeldLessThanATenth) {
  EXPECT_EQ(CountWarnings(0, 24, 0, 500), 1u);
  EXPECT_EQ(CountWarnings(2, 24, 0, 500), 1u);  // 8.3 %
  EXPECT_EQ(CountWarnings(3, 24, 0, 500), 0u);  // 12.5 %
  EXPECT_EQ(CountWarnings(2, 20, 0, 500), 0u);  // a tenth
  EXPECT_EQ(CountWarnings(0, 0, 0, 500), 0u);   // not checked
  EXPECT_NE(
      ListDevelopmentWarnings(Hand(), MakeDeveloped(0, 24, 0, 500)).front().find("0 of 24 shapes"),
      std::string::npos);
}

// tum's thumb and index oppose; two fingers side by side on a palm do not.
TEST(DevelopmentWarnings, TwoDigitsThatFailAreAskedWhetherTheyCanOppose) {
  const Hand hand = LoadHand("tum");
  DevelopedGrasp developed = MakeDeveloped(5, 24, 0, 500);
  developed.grasp.digits = {"TH", hand.digits.front().id};
  EXPECT_TRUE(ListDevelopmentWarnings(hand, developed).empty());
  developed.grasp.digits = {hand.digits[0].id, hand.digits[1].id};
  const auto warnings = ListDevelopmentWarnings(hand, developed);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find(" cannot oppose: "), std::string::npos);
  developed.check = MakeDeveloped(12, 24, 0, 500).check;
  EXPECT_TRUE(ListDevelopmentWarnings(hand, developed).empty());
}

TEST(DevelopmentWarnings, NamesNumericalFailuresAboveOnePercent) {
  EXPECT_EQ(CountWarnings(24, 24, 5, 500), 0u);  // 1 %
  EXPECT_EQ(CountWarnings(24, 24, 6, 500), 1u);
  EXPECT_EQ(CountWarnings(0, 24, 6, 500), 2u);
  EXPECT_NE(ListDevelopmentWarnings(Hand(), MakeDeveloped(24, 24, 8, 500))
                .front()
                .find("8 of 500 trials (1.6 %) failed numerically"),
            std::string::npos);
}

}  // namespace
}  // namespace graspbench
