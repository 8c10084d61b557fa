#include "core/statistics/ranks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

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

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/** Cells of ten trials whose means differ far more than their trials do; b = slope a + noise. The
generator is the standard library's, not ours. */
std::vector<PairedGroup> MakeCells(unsigned seed, int num_cells, double slope) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<PairedGroup> cells;
  for (int c = 0; c < num_cells; ++c) {
    const double mean = 20.0 * normal(generator);
    PairedGroup cell;
    for (int i = 0; i < 10; ++i) {
      const double a = normal(generator);
      cell.a.push_back(mean + a);
      cell.b.push_back(-3.0 * mean + slope * a + normal(generator));
    }
    cells.push_back(cell);
  }
  return cells;
}

TEST(WithinGroups, OneGroupIsSpearman) {
  const PairedGroup group = {{3.0, 1.0, 4.0, 1.0, 5.0, 9.0}, {2.0, 7.0, 1.0, 8.0, 2.0, 8.0}};
  const auto within = CalcWithinCorrelation({group}, "one");
  ASSERT_TRUE(within);
  EXPECT_NEAR(within->correlation, *CalcSpearman(group.a, group.b), 1e-12);
  EXPECT_FALSE(within->interval);
}

// All six orders of three pairs: two of them, the ends, give a correlation as large as 1.
TEST(WithinGroups, TheShufflesOfThreePairsAreCounted) {
  const auto within = CalcWithinCorrelation({{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}}, "three", 20000);
  ASSERT_TRUE(within);
  EXPECT_NEAR(within->p, 1.0 / 3.0, 0.015);
}

TEST(WithinGroups, WhatLiesBetweenGroupsIsNoEffect) {
  const auto cells = MakeCells(1, 200, 0.0);
  std::vector<double> a, b;
  for (const PairedGroup& cell : cells) {
    a.insert(a.end(), cell.a.begin(), cell.a.end());
    b.insert(b.end(), cell.b.begin(), cell.b.end());
  }
  EXPECT_LT(*CalcSpearman(a, b), -0.9);
  const auto within = CalcWithinCorrelation(cells, "between");
  ASSERT_TRUE(within);
  EXPECT_NEAR(within->correlation, 0.0, 0.08);  // 3.4 standard deviations of 2,000 pairs
}

TEST(WithinGroups, APlantedEffectIsFound) {
  const auto within = CalcWithinCorrelation(MakeCells(2, 20, 0.5), "planted");
  ASSERT_TRUE(within && within->interval);
  // Pearson's would be 0.5 / sqrt(1.25) = 0.45; ranks of few lose a little.
  EXPECT_NEAR(within->correlation, 0.42, 0.12);
  EXPECT_GT(within->interval->low, 0.1);
  EXPECT_LT(within->p, 0.01);
}

TEST(WithinGroups, PlantedIndependenceIsRarelyCalledAnEffect) {
  int num_found = 0, num_excluded = 0;
  const int num_runs = 300;
  for (int run = 0; run < num_runs; ++run) {
    const auto within = CalcWithinCorrelation(MakeCells(100 + static_cast<unsigned>(run), 8, 0.0),
                                              "run " + std::to_string(run), 199);
    ASSERT_TRUE(within && within->interval);
    num_found += within->p <= 0.05 ? 1 : 0;
    num_excluded += within->interval->low > 0.0 || within->interval->high < 0.0 ? 1 : 0;
  }
  // 5 % are 15; 26 or more come once in 200 such series.
  EXPECT_LE(num_found, 25);
  EXPECT_GE(num_found, 5);
  // Intervals from eight groups are somewhat too narrow.
  EXPECT_LE(num_excluded, 40);
}

TEST(WithinGroups, MissingPairsAndGroupsWithoutSpreadAreLeftOut) {
  const PairedGroup group = {{1.0, 2.0, kNan, 3.0}, {1.0, kNan, 5.0, 2.0}};
  EXPECT_FALSE(CalcWithinCorrelation({group}, "two pairs"));
  EXPECT_FALSE(CalcWithinCorrelation({}, "none"));
  const PairedGroup tied = {{1.0, 2.0, 3.0}, {1.0, 1.0, 1.0}};
  EXPECT_FALSE(CalcWithinCorrelation({tied}, "tied"));
  const auto within =
      CalcWithinCorrelation({tied, {{1.0, 2.0, 3.0, kNan}, {3.0, 2.0, 1.0, 0.0}}}, "one");
  ASSERT_TRUE(within);
  EXPECT_EQ(within->num_groups, 1);
  EXPECT_EQ(within->num_pairs, 3);
  EXPECT_NEAR(within->correlation, -1.0, 1e-12);
}

}  // namespace
}  // namespace graspbench
