#include "core/statistics/proportion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace graspbench {
namespace {

TEST(WilsonInterval, AgreesWithNewcombe1998) {
  // Newcombe, Stat. Med. 17 (1998), table I, method 3.
  const struct {
    int successes, trials;
    double low, high;
  } published[] = {{81, 263, 0.2553, 0.3662},
                   {15, 148, 0.0624, 0.1605},
                   {0, 20, 0.0000, 0.1611},
                   {1, 29, 0.0061, 0.1718}};
  for (const auto& known : published) {
    const Interval interval = CalcWilsonInterval(known.successes, known.trials);
    EXPECT_NEAR(interval.low, known.low, 5e-5) << known.successes << "/" << known.trials;
    EXPECT_NEAR(interval.high, known.high, 5e-5) << known.successes << "/" << known.trials;
  }
}

TEST(WilsonInterval, EndsSolveTheScoreEquation) {
  // |p - theta| = z sqrt(theta (1 - theta) / n) at both ends.
  constexpr double kZ = 1.959963984540054;
  for (int n : {1, 2, 10, 1000}) {
    for (int k = 0; k <= n; k += std::max(1, n / 7)) {
      const Interval interval = CalcWilsonInterval(k, n);
      for (double theta : {interval.low, interval.high}) {
        EXPECT_NEAR(std::abs(static_cast<double>(k) / n - theta),
                    kZ * std::sqrt(theta * (1.0 - theta) / n), 1e-12);
      }
      EXPECT_LE(interval.low, static_cast<double>(k) / n);
      EXPECT_GE(interval.high, static_cast<double>(k) / n);
    }
  }
}

// By hand: of ten pairs that differ, nine for one side: 2 (1 + 10) / 2^10.
TEST(McNemarExact, IsTwiceTheBinomialTail) {
  PairedCounts counts;
  EXPECT_EQ(CalcMcNemarExactTwoSided(counts), 1.0);
  counts = {20, 9, 1, 5};
  EXPECT_NEAR(CalcMcNemarExactTwoSided(counts), 22.0 / 1024.0, 1e-12);
  counts = {0, 3, 3, 0};
  EXPECT_EQ(CalcMcNemarExactTwoSided(counts), 1.0);
}

TEST(FisherExact, TheLadyTastingTea) {
  // Fisher 1935: three of four cups right each; (16 + 16 + 1 + 1) / 70.
  EXPECT_NEAR(CalcFisherExactTwoSided(3, 4, 1, 4), 34.0 / 70.0, 1e-12);
  EXPECT_NEAR(CalcFisherExactTwoSided(4, 4, 0, 4), 2.0 / 70.0, 1e-12);
}

TEST(FisherExact, TheConvictionsOfTwins) {
  // Fisher's twins: 10 of 13 monozygotic and 2 of 17 dizygotic twins convicted, p = 0.0005367.
  EXPECT_NEAR(CalcFisherExactTwoSided(10, 13, 2, 17), 0.0005367, 5e-8);
}

// R. G. Newcombe 1998, method 10: 36 pairs positive twice, 12 and 2 once: 0.0569 to 0.3404.
TEST(PairedDifference, AgreesWithNewcombe) {
  const Interval interval = CalcPairedDifferenceInterval({36, 2, 12, 0});
  EXPECT_NEAR(interval.low, 0.0569, 5e-5);
  EXPECT_NEAR(interval.high, 0.3404, 5e-5);
}

double CalcChoose(int n, int k);

// Every outcome of n pairs with its probability: the interval holds the true difference in 95 % of
// them, or nearly so; Newcombe's own check of the method.
TEST(PairedDifference, CoversTheTruthOverAllOutcomes) {
  constexpr int kPairs = 24;
  double mean = 0.0;
  int num_truths = 0;
  for (const double both : {0.2, 0.5, 0.7, 0.85}) {
    for (const double first_only : {0.01, 0.05, 0.1}) {
      for (const double second_only : {0.02, 0.04}) {
        const double neither = 1.0 - both - first_only - second_only;
        double covered = 0.0, all = 0.0;
        for (int a = 0; a <= kPairs; ++a) {
          for (int b = 0; a + b <= kPairs; ++b) {
            for (int c = 0; a + b + c <= kPairs; ++c) {
              const int d = kPairs - a - b - c;
              const double probability = CalcChoose(kPairs, a) * CalcChoose(kPairs - a, b) *
                                         CalcChoose(kPairs - a - b, c) * std::pow(both, a) *
                                         std::pow(first_only, b) * std::pow(second_only, c) *
                                         std::pow(neither, d);
              const Interval interval = CalcPairedDifferenceInterval({a, b, c, d});
              const double truth = second_only - first_only;
              all += probability;
              if (interval.low <= truth && truth <= interval.high) covered += probability;
            }
          }
        }
        EXPECT_NEAR(all, 1.0, 1e-9);
        EXPECT_GT(covered, 0.93) << both << ' ' << first_only << ' ' << second_only;
        mean += covered;
        ++num_truths;
      }
    }
  }
  EXPECT_GT(mean / num_truths, 0.95);
  EXPECT_LT(mean / num_truths, 0.995);  // few differing pairs: it errs on the wide side
}

double CalcChoose(int n, int k) {
  double value = 1.0;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

TEST(FisherExact, AgreesWithCountingAllTables) {
  for (int n_a = 1; n_a <= 10; ++n_a) {
    for (int k_a = 0; k_a <= n_a; ++k_a) {
      for (int k_b = 0; k_b <= 10; ++k_b) {
        const auto count = [&](int k) {  // tables with k successes in a; exact in double
          const int other = k_a + k_b - k;
          return other < 0 || other > 10 ? 0.0 : CalcChoose(n_a, k) * CalcChoose(10, other);
        };
        double as_rare = 0.0, all = 0.0;
        for (int k = 0; k <= n_a; ++k) {
          all += count(k);
          if (std::round(count(k)) <= std::round(count(k_a))) as_rare += count(k);
        }
        EXPECT_NEAR(CalcFisherExactTwoSided(k_a, n_a, k_b, 10), as_rare / all, 1e-11);
        EXPECT_EQ(CalcFisherExactTwoSided(k_a, n_a, k_b, 10) > 0.0, true);
      }
    }
  }
}

TEST(FisherExact, DoesNotCareWhichComesFirstAndHoldsForMany) {
  EXPECT_NEAR(CalcFisherExactTwoSided(7, 10, 2, 12), CalcFisherExactTwoSided(2, 12, 7, 10), 1e-14);
  EXPECT_NEAR(CalcFisherExactTwoSided(5000, 10000, 5000, 10000), 1.0, 1e-9);
  EXPECT_EQ(CalcFisherExactTwoSided(0, 0, 3, 7), 1.0);
}

// 9 of 10: 59.58 to 98.21 % (Wilson 1927; table in Newcombe 1998 for the method).
TEST(Rate, ComesWithCountsAndInterval) {
  EXPECT_EQ(FormatRate(9, 10),
            "9 of 10 trials (90.0\u00A0%, 95\u00A0% interval 59.6 to 98.2\u00A0%)");
  EXPECT_EQ(FormatRate(0, 0), "0 of 0 trials");
  EXPECT_EQ(FormatRateInterval(0, 0), "n/a");
}

}  // namespace
}  // namespace graspbench
