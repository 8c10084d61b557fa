// Planted: how often two controllers are called different, by simulation.
//
// Each of 21 objects has success probabilities of its own (first controller: 0.4 to 0.8, evenly). A
// pair shares its draw: both succeed where one even number is below both probabilities. So only
// draws between the two, and a share that chance turns over, differ. The difference of an object is
// 10 points (0 for equals), give or take a normal deviate of 5 points.

#include <gtest/gtest.h>

#include <cstdio>

#include "core/base/random.h"
#include "core/statistics/paired_clusters.h"

namespace graspbench {
namespace {

constexpr int kObjects = 21;
constexpr double kSpread = 0.05, kTurnedOver = 0.1;

std::vector<PairedCounts> Simulate(double difference, int num_pairs, RandomStream& stream) {
  std::vector<PairedCounts> clusters(kObjects);
  for (PairedCounts& counts : clusters) {
    const double first = stream.NextUniform(0.4, 0.8);
    const double second = first + difference + kSpread * stream.NextNormal();
    for (int pair = 0; pair < num_pairs / kObjects; ++pair) {
      const double draw = stream.NextUnit();
      const bool is_turned = stream.NextUnit() < kTurnedOver;
      const double other = is_turned ? stream.NextUnit() : draw;
      counts.Add(draw < first, other < second);
    }
  }
  return clusters;
}

/** Of the model, by many pairs. */
double MeasureDiscordance(double difference) {
  RandomStream stream("discordance", "planted");
  int num = 0, num_differing = 0;
  for (const PairedCounts& counts : Simulate(difference, 2100000, stream)) {
    num += counts.num_pairs();
    num_differing += counts.first_only + counts.second_only;
  }
  return static_cast<double>(num_differing) / num;
}

int CountDecided(double difference, int num_pairs, int num_comparisons, bool wants_sign) {
  RandomStream stream("comparisons", "planted " + std::to_string(difference));
  int num_decided = 0;
  for (int i = 0; i < num_comparisons; ++i) {
    const auto clusters = Simulate(difference, num_pairs, stream);
    int gain = 0;
    for (const PairedCounts& counts : clusters) gain += counts.second_only - counts.first_only;
    num_decided += CalcClusteredExactTwoSided(clusters) < 0.05 && (!wants_sign || gain > 0);
  }
  return num_decided;
}

TEST(PlantedDifferences, AreDecidedAsOftenAsThePlanSays) {
  const double discordance = MeasureDiscordance(0.1);
  const auto num_pairs = CalcPairsNeeded({0.1, discordance, kSpread, kObjects});
  ASSERT_TRUE(num_pairs);
  std::printf("of 20000 comparisons: %.1f %% decided, equal: %.1f %%\n",
              CountDecided(0.1, *num_pairs, 20000, true) / 200.0,
              CountDecided(0.0, *num_pairs, 20000, false) / 200.0);
  const int different = CountDecided(0.1, *num_pairs, 200, true);
  const int equal = CountDecided(0.0, *num_pairs, 400, false);
  std::printf(
      "pairs planned for 80 %%: %d (%.1f %% differ); decided: %d of 200; equal: %d of 400\n",
      *num_pairs, 100.0 * discordance, different, equal);
  EXPECT_GE(different, 150);
  EXPECT_LE(equal, 30);
}

// A pilot of as many pairs plans the next comparison.
TEST(PlantedDifferences, APilotPlansAsWell) {
  RandomStream stream("pilot", "planted");
  std::vector<double> planned;
  for (int i = 0; i < 200; ++i) {
    const auto pairs = CalcPairsNeeded(EstimatePairedPlan(Simulate(0.1, 210, stream), 0.1));
    planned.push_back(pairs ? *pairs : 1e6);
  }
  std::sort(planned.begin(), planned.end());
  std::printf("planned by pilots of 210 pairs: median %g, 10 %% below %g, 10 %% above %g\n",
              planned[100], planned[20], planned[180]);
  const auto known = CalcPairsNeeded({0.1, MeasureDiscordance(0.1), kSpread, kObjects});
  EXPECT_GT(planned[100], 0.5 * *known);
  EXPECT_LT(planned[100], 2.0 * *known);
}

}  // namespace
}  // namespace graspbench
