#include "core/statistics/ranks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace graspbench {
namespace {

TEST(RankValues, TiesShareTheirAverage) {
  EXPECT_EQ(RankValues({3.0, 1.0, 3.0, 2.0}).twice, (std::vector<int>{7, 2, 7, 4}));
  EXPECT_EQ(RankValues({3.0, 1.0, 3.0, 2.0}).tie_sum, 6.0);
}

TEST(Spearman, AgreesWithTheFormulaWithoutTies) {
  // rho = 1 - 6 sum d^2 / (n (n^2 - 1)): ranks of b are 2 1 4 3 5, d^2 sums to 4.
  const auto rho = CalcSpearman({1, 2, 3, 4, 5}, {20, 10, 40, 30, 50});
  ASSERT_TRUE(rho) << rho.reason();
  EXPECT_NEAR(*rho, 1.0 - 6.0 * 4.0 / 120.0, 1e-15);
}

TEST(Spearman, SeesOrderOnly) {
  const std::vector<double> a = {0.3, 2.0, 1.1, 7.0, 5.5}, b = {1.0, 3.0, 3.0, 4.0, 2.0};
  std::vector<double> bent, turned;
  for (double value : a) bent.push_back(std::exp(value));
  for (double value : b) turned.push_back(-value);
  EXPECT_EQ(*CalcSpearman(a, b), *CalcSpearman(bent, b));
  EXPECT_EQ(*CalcSpearman(a, b), -*CalcSpearman(a, turned));
  EXPECT_EQ(*CalcSpearman(a, bent), 1.0);
}

TEST(Spearman, GivesReasons) {
  EXPECT_EQ(CalcSpearman({1, 2}, {1, 2}).reason(), "2 pairs; expected 3 or more");
  EXPECT_EQ(CalcSpearman({1, 2, 3}, {4, 4, 4}).reason(), "all values of one side are equal");
  EXPECT_EQ(CalcSpearman({1, 2, NAN}, {4, 5, 6}).reason(), "a value is missing");
}

TEST(RocArea, AgreesWithCountingThePairs) {
  RandomStream random("roc", "test");
  std::vector<double> scores;
  std::vector<bool> is_positive;
  for (int i = 0; i < 40; ++i) {
    is_positive.push_back(random.NextUnit() < 0.4);
    scores.push_back(random.NextIndex(8) + (is_positive.back() ? 2 : 0));
  }
  double won = 0.0, pairs = 0.0;
  for (size_t i = 0; i < scores.size(); ++i) {
    for (size_t j = 0; j < scores.size(); ++j) {
      if (!is_positive[i] || is_positive[j]) continue;
      pairs += 1.0;
      won += scores[i] > scores[j] ? 1.0 : scores[i] == scores[j] ? 0.5 : 0.0;
    }
  }
  const auto area = CalcRocArea(scores, is_positive);
  ASSERT_TRUE(area) << area.reason();
  EXPECT_NEAR(*area, won / pairs, 1e-14);
  EXPECT_EQ(*CalcRocArea({1, 2, 3}, {false, true, true}), 1.0);
  EXPECT_EQ(CalcRocArea({1, 2}, {true, true}).reason(), "there is no failure");
}

}  // namespace
}  // namespace graspbench
