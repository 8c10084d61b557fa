#include "core/statistics/paired_clusters.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace graspbench {
namespace {

PairedCounts MakeGain(int lost, int gained, int both = 0) { return {both, lost, gained, 0}; }

TEST(PairedClusters, CountsAllSigns) {
  // Differences 1, 2, 3: |sum| is 6 in 2 of 8 ways; with 3, 1, -1: at least 3 in 6 of 8 (5, 3, 3).
  EXPECT_DOUBLE_EQ(CalcClusteredExactTwoSided({MakeGain(0, 1), MakeGain(1, 3), MakeGain(0, 3, 9)}),
                   0.25);
  EXPECT_DOUBLE_EQ(CalcClusteredExactTwoSided({MakeGain(0, 3), MakeGain(0, 1), MakeGain(1, 0)}),
                   0.75);
  EXPECT_DOUBLE_EQ(CalcClusteredExactTwoSided(std::vector<PairedCounts>(6, MakeGain(0, 1))),
                   2.0 / 64.0);
  EXPECT_DOUBLE_EQ(CalcClusteredExactTwoSided({}), 1.0);
  EXPECT_DOUBLE_EQ(CalcClusteredExactTwoSided({MakeGain(4, 4)}), 1.0);
}

// One pair an object that differs: McNemar's exact test.
TEST(PairedClusters, OfSinglePairsItIsMcNemars) {
  PairedCounts sum;
  std::vector<PairedCounts> clusters;
  for (int i = 0; i < 17; ++i) {
    clusters.push_back(i < 4 ? MakeGain(1, 0) : MakeGain(0, 1));
    ++(i < 4 ? sum.first_only : sum.second_only);
  }
  EXPECT_NEAR(CalcClusteredExactTwoSided(clusters), CalcMcNemarExactTwoSided(sum), 1e-12);
}

TEST(PairedClusters, ThePlanIsThatOfTheNormalDistributionForManyObjects) {
  // (1.959964 sqrt(q - D^2) + 0.841621 sqrt(q - D^2))^2 / D^2 with q = 0.3, D = 0.1: 227.6
  EXPECT_NEAR(*CalcPairsNeeded({0.1, 0.3, 0.0, 20000}), 20000, 0);  // one pair each is enough
  // With t of 20 degrees of freedom and D - 1 / n in the place of D: some 20 % more.
  EXPECT_GE(*CalcPairsNeeded({0.1, 0.3, 0.0, 21}), 228);
  EXPECT_LE(*CalcPairsNeeded({0.1, 0.3, 0.0, 21}), 294);
  EXPECT_FALSE(CalcPairsNeeded({0.1, 0.3, 0.0, 5}));
  EXPECT_FALSE(CalcPairsNeeded({0.1, 0.3, 0.3, 10})) << "more pairs do not help";
}

TEST(PairedClusters, EstimatesSpreadBetweenObjects) {
  // Differences of +-1 without chance: the spread is that of +1, -1, +1, -1.
  const std::vector<PairedCounts> all = {MakeGain(0, 50), MakeGain(50, 0), MakeGain(0, 50),
                                         MakeGain(50, 0)};
  EXPECT_NEAR(EstimatePairedPlan(all, 0.1).spread, std::sqrt(4.0 / 3.0 - 1.0 / 50.0), 1e-12);
  EXPECT_DOUBLE_EQ(EstimatePairedPlan(all, 0.1).discordance, 1.0);
  const std::vector<PairedCounts> none(4, MakeGain(5, 5, 40));
  EXPECT_EQ(EstimatePairedPlan(none, 0.1).spread, 0.0);
  EXPECT_DOUBLE_EQ(EstimatePairedPlan(none, 0.1).discordance, 0.2);
}

}  // namespace
}  // namespace graspbench
