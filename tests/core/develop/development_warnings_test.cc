#include "core/develop/development_warnings.h"

#include <gtest/gtest.h>

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
  return ListDevelopmentWarnings(MakeDeveloped(num_held, num_shapes, num_failed, num_trials))
      .size();
}

TEST(DevelopmentWarnings, NamesWhatHeldLessThanATenth) {
  EXPECT_EQ(CountWarnings(0, 24, 0, 500), 1u);
  EXPECT_EQ(CountWarnings(2, 24, 0, 500), 1u);  // 8.3 %
  EXPECT_EQ(CountWarnings(3, 24, 0, 500), 0u);  // 12.5 %
  EXPECT_EQ(CountWarnings(2, 20, 0, 500), 0u);  // a tenth
  EXPECT_EQ(CountWarnings(0, 0, 0, 500), 0u);   // not checked
  EXPECT_NE(ListDevelopmentWarnings(MakeDeveloped(0, 24, 0, 500)).front().find("0 of 24 shapes"),
            std::string::npos);
}

TEST(DevelopmentWarnings, NamesAScoreBelowThatOfTheGeometricStart) {
  DevelopedGrasp developed = MakeDeveloped(24, 24, 0, 500);
  developed.proposed_score = 0.625;
  developed.score = 0.625;
  EXPECT_TRUE(ListDevelopmentWarnings(developed).empty());
  developed.score = 0.5;
  ASSERT_EQ(ListDevelopmentWarnings(developed).size(), 1u);
  EXPECT_EQ(ListDevelopmentWarnings(developed)[0].find(
                "it scores 0.50 in the finals, the geometric start 0.62"),
            0u);
}

TEST(DevelopmentWarnings, NamesNumericalFailuresAboveOnePercent) {
  EXPECT_EQ(CountWarnings(24, 24, 5, 500), 0u);  // 1 %
  EXPECT_EQ(CountWarnings(24, 24, 6, 500), 1u);
  EXPECT_EQ(CountWarnings(0, 24, 6, 500), 2u);
  EXPECT_NE(ListDevelopmentWarnings(MakeDeveloped(24, 24, 8, 500))
                .front()
                .find("8 of 500 trials (1.6 %) failed numerically"),
            std::string::npos);
}

}  // namespace
}  // namespace graspbench
