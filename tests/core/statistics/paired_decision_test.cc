#include "core/statistics/paired_decision.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace graspbench {
namespace {

PairedCounts MakeCounts(int lost, int gained, int num_pairs) {
  PairedCounts counts;
  counts.first_only = lost;
  counts.second_only = gained;
  counts.both = num_pairs - lost - gained;
  return counts;
}

// With p10 the probability of a loss, p01 = p10 - m that of a gain and the rest as it is, the score
// is that of the likelihood's maximum, here sought by brute force.
TEST(PairedDecision, ItsScoreIsThatOfTheMostLikelyTable) {
  constexpr double m = kSuccessMargin;
  for (const auto& [lost, gained, n] :
       {std::tuple{0, 0, 100}, {1, 0, 100}, {3, 10, 100}, {2, 2, 40}, {5, 0, 60}, {0, 7, 20}}) {
    double best = -1e300, best_gain = 0.0;
    for (double gain = 1e-7; gain < 0.5 * (1.0 - m); gain += 1e-6) {
      const double likelihood = lost * std::log(gain + m) + gained * std::log(gain) +
                                (n - lost - gained) * std::log(1.0 - 2.0 * gain - m);
      if (likelihood > best) best = likelihood, best_gain = gain;
    }
    const double variance = 2.0 * best_gain + m - m * m;
    EXPECT_NEAR(CalcNonInferiorityScore(MakeCounts(lost, gained, n)),
                (gained - lost + n * m) / std::sqrt(n * variance), 1e-4)
        << lost << " " << gained << " " << n;
  }
}

TEST(PairedDecision, EndsWhereTheTextSays) {
  // Nothing lost: the score is sqrt(n m / (1 - m)), shown at 80 of 100, not yet at 60.
  EXPECT_EQ(Decide({MakeCounts(0, 0, 60), 60, 0}, 3, 5), PairedDecision::kGoOn);
  EXPECT_EQ(Decide({MakeCounts(0, 0, 80), 80, 0}, 4, 5), PairedDecision::kTaken);
  // Much gained: early.
  EXPECT_EQ(Decide({MakeCounts(0, 20, 20), 20, 0}, 1, 5), PairedDecision::kTaken);
  // Two lost of twenty may be chance, three hardly; in the end five of a hundred are too many.
  EXPECT_EQ(Decide({MakeCounts(2, 0, 20), 20, 0}, 1, 5), PairedDecision::kGoOn);
  EXPECT_EQ(Decide({MakeCounts(3, 0, 20), 20, 0}, 1, 5), PairedDecision::kSucceedsLess);
  EXPECT_EQ(Decide({MakeCounts(6, 0, 100), 100, 0}, 5, 5), PairedDecision::kSucceedsLess);
  EXPECT_EQ(Decide({MakeCounts(0, 0, 20), 10, 10}, 1, 5), PairedDecision::kIsNotBetter);
  EXPECT_EQ(Decide({MakeCounts(0, 0, 100), 55, 45}, 5, 5), PairedDecision::kIsNotDecided);
  EXPECT_EQ(Decide({MakeCounts(2, 0, 100), 100, 0}, 5, 5), PairedDecision::kIsNotDecided);
  // Ties say nothing.
  EXPECT_EQ(Decide({MakeCounts(0, 0, 100), 0, 0}, 5, 5), PairedDecision::kIsNotBetter);
}

struct Truth {
  double lost = 0.0, gained = 0.0, better = 0.5;
};

/** The share of decisions that take the new one. */
double SimulateTaken(const Truth& truth, const char* name, int num_looks = kMostLooks) {
  RandomStream stream(name, "paired decisions");
  constexpr int kNumDecisions = 20000;
  int num_taken = 0;
  for (int i = 0; i < kNumDecisions; ++i) {
    PairedEvidence evidence;
    PairedDecision decision = PairedDecision::kGoOn;
    for (int look = 1; decision == PairedDecision::kGoOn; ++look) {
      for (int pair = 0; pair < kPairsPerLook; ++pair) {
        const double u = stream.NextUnit();
        evidence.success.Add(u >= truth.gained, u >= truth.gained + truth.lost || u < truth.gained);
        ++(stream.NextUnit() < truth.better ? evidence.num_better : evidence.num_worse);
      }
      decision = Decide(evidence, look, num_looks);
    }
    num_taken += decision == PairedDecision::kTaken;
  }
  return static_cast<double>(num_taken) / kNumDecisions;
}

// Three standard deviations of a share of 5 % over 20,000 decisions are 0.46 points.
TEST(PairedDecision, TakesAtMostFivePercentOfWhatIsFivePointsWorse) {
  for (const double gained : {0.0, 0.01, 0.05, 0.1, 0.2}) {
    EXPECT_LT(SimulateTaken({gained + kSuccessMargin, gained, 1.0}, "worse"), 0.055) << gained;
  }
}

TEST(PairedDecision, TakesAtMostFivePercentOfWhatIsNotBetter) {
  for (const int num_looks : {1, 3, 5}) {
    EXPECT_LT(SimulateTaken({0.0, 0.2, 0.5}, "no better", num_looks), 0.055) << num_looks;
  }
}

TEST(PairedDecision, TakesWhatIsBetter) {
  EXPECT_GT(SimulateTaken({0.0, 0.0, 0.9}, "as sure"), 0.99);
  EXPECT_GT(SimulateTaken({0.02, 0.12, 0.9}, "surer"), 0.9);
}

}  // namespace
}  // namespace graspbench
