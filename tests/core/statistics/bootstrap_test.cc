#include "core/statistics/bootstrap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/statistics/distributions.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

GroupStatistic MakeMean(const std::vector<double>& values) {
  return [&values](const std::vector<size_t>& members) {
    double sum = 0.0;
    for (size_t member : members) sum += values[member];
    return sum / static_cast<double>(members.size());
  };
}

TEST(Bootstrap, AgreesWithEfronAndTibshirani) {
  // "An introduction to the bootstrap", 1993, section 14.2: variance (divided by n) of test A of 26
  // children; 171.5, a = 0.061, z0 = 0.146 from 2000 resamples.
  const std::vector<double> scores = {48, 36, 20, 29, 42, 42, 20, 42, 22, 41, 45, 14, 6,
                                      0,  33, 28, 34, 4,  32, 24, 47, 41, 24, 26, 30, 41};
  const auto statistic = [&](const std::vector<size_t>& members) {
    const double mean = MakeMean(scores)(members);
    double sum = 0.0;
    for (size_t member : members) sum += (scores[member] - mean) * (scores[member] - mean);
    return sum / static_cast<double>(members.size());
  };
  const auto result = CalcBootstrap(scores.size(), statistic, "spatial");
  ASSERT_TRUE(result) << result.reason();
  EXPECT_NEAR(result->estimate, 171.5, 0.05);
  EXPECT_NEAR(result->acceleration, 0.061, 5e-4);
  EXPECT_NEAR(result->bias_correction, 0.146, 0.05);  // theirs +- 0.028, ours +- 0.013
}

TEST(Bootstrap, AgreesWithAllResamplesOfFive) {
  const std::vector<double> values = {0.3, 1.1, 1.9, 2.2, 7.0};
  const GroupStatistic mean = MakeMean(values);
  const auto result = CalcBootstrap(5, mean, "five", 50000);
  ASSERT_TRUE(result) << result.reason();
  // All 5^5 ordered draws are equally likely.
  std::vector<double> all;
  for (size_t code = 0; code < 3125; ++code) {
    all.push_back(mean({code % 5, code / 5 % 5, code / 25 % 5, code / 125 % 5, code / 625}));
  }
  std::sort(all.begin(), all.end());
  double below = 0.0;
  for (double value : all)
    below += value < result->estimate ? 1.0 : value == result->estimate ? 0.5 : 0.0;
  EXPECT_NEAR(result->bias_correction, CalcNormalQuantile(below / 3125.0), 0.02);
  // For the mean, a is the skewness of the values / (6 sqrt(n)).
  double squares = 0.0, cubes = 0.0;
  for (double value : values) {
    squares += std::pow(value - 2.5, 2);
    cubes += std::pow(value - 2.5, 3);
  }
  EXPECT_NEAR(result->acceleration, cubes / (6.0 * std::pow(squares, 1.5)), 1e-12);
  for (const auto& [p, limit] :
       {std::pair{0.025, result->interval.low}, std::pair{0.975, result->interval.high}}) {
    const double z = result->bias_correction + CalcNormalQuantile(p);
    const double wanted =
        CalcNormalP(result->bias_correction + z / (1.0 - result->acceleration * z));
    // The draws have atoms: the wanted share lies within the step at the limit.
    const auto share_below = [&](double value) {
      return static_cast<double>(std::lower_bound(all.begin(), all.end(), value) - all.begin()) /
             3125.0;
    };
    EXPECT_GT(wanted, share_below(limit - 1e-9) - 0.004);
    EXPECT_LT(wanted, share_below(limit + 1e-9) + 0.004);
  }
}

TEST(Bootstrap, CoversTheMeanAboutAsOftenAsItSays) {
  RandomStream random("coverage", "test");
  int num_covered = 0;
  for (int study = 0; study < 300; ++study) {
    std::vector<double> values;
    for (int member = 0; member < 20; ++member) values.push_back(5.0 + random.NextNormal());
    const auto result = CalcBootstrap(20, MakeMean(values), std::to_string(study), 999);
    num_covered += result->interval.low < 5.0 && 5.0 < result->interval.high;
  }
  // 93 % is expected for 20 normal values; three binomial deviations of 300 are 4 %.
  EXPECT_NEAR(num_covered / 300.0, 0.93, 0.045);
}

TEST(Bootstrap, GivesReasons) {
  const std::vector<double> same(6, 0.1), some = {1, 2, 3, 4, 5, 6};
  EXPECT_EQ(CalcBootstrap(4, MakeMean(some), "x").reason(),
            "4 to resample; an interval needs 5 or more");
  EXPECT_EQ(CalcBootstrap(6, MakeMean(same), "x").reason(),
            "the statistic is the same for every resample");
  const auto nothing = [](const std::vector<size_t>&) { return NAN; };
  EXPECT_EQ(CalcBootstrap(6, nothing, "x").reason(), "the statistic has no value");
  const auto needs_first = [&](const std::vector<size_t>& members) {
    return std::find(members.begin(), members.end(), 0u) == members.end() ? NAN
                                                                          : MakeMean(some)(members);
  };
  EXPECT_EQ(CalcBootstrap(6, needs_first, "x").reason(),
            "the statistic has no value without member 1");
  const auto needs_all = [&](const std::vector<size_t>& members) {
    return std::count(members.begin(), members.end(), members[0]) > 2 ? NAN
                                                                      : MakeMean(some)(members);
  };
  EXPECT_EQ(CalcBootstrap(6, needs_all, "x").reason(),
            "the statistic has no value for some resamples");
}

// Student's sleep data, difference of the two drugs; R 4.2: t.test(...): t = 4.0621, df = 9,
// p-value = 0.002833, 0.7001142 to 2.4598858.
TEST(Jackknife, OfTheMeanIsStudentsT) {
  const std::vector<double> extra = {1.2, 2.4, 1.3, 1.3, 0.0, 1.0, 1.8, 0.8, 4.6, 1.4};
  const Answer<JackknifeInterval> result = CalcJackknife(extra.size(), MakeMean(extra));
  ASSERT_TRUE(result) << result.reason();
  EXPECT_NEAR(result->estimate, 1.58, 1e-12);
  EXPECT_NEAR(result->estimate / result->standard_error, 4.0621, 5e-5);
  EXPECT_NEAR(result->interval.low, 0.7001142, 5e-8);
  EXPECT_NEAR(result->interval.high, 2.4598858, 5e-8);
  EXPECT_NEAR(result->p, 0.002833, 5e-7);
}

TEST(Jackknife, GivesReasons) {
  const auto constant = [](const std::vector<size_t>&) { return 1.0; };
  EXPECT_EQ(CalcJackknife(2, constant).reason(), "2 to leave out; an interval needs 3 or more");
  EXPECT_EQ(CalcJackknife(3, constant).reason(), "the statistic is the same for every resample");
  const auto missing = [](const std::vector<size_t>& members) {
    return members.front() == 0 ? static_cast<double>(members.size()) : std::nan("");
  };
  EXPECT_EQ(CalcJackknife(3, missing).reason(), "the statistic has no value without member 1");
}

}  // namespace
}  // namespace graspbench
