#include "core/base/random.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/hash.h"

namespace graspbench {
namespace {

// XXH64 of the empty input with seed 0, published with the algorithm.
TEST(Hash, AgreesWithThePublishedValue) { EXPECT_EQ(CalcHashHex(""), "ef46db3751d8e999"); }

TEST(RandomStream, NamesDecideTheNumbers) {
  RandomStream a("trial", "pose"), same("trial", "pose"), other("trial", "joints");
  const uint64_t first = a.NextBits();
  EXPECT_EQ(first, same.NextBits());
  EXPECT_NE(first, other.NextBits());
}

// Moments of the uniform and the normal distribution, within five standard errors.
TEST(RandomStream, HasTheMomentsOfItsDistributions) {
  constexpr int kCount = 200000;
  RandomStream stream("moments", "test");
  double sum = 0.0, sum_squares = 0.0, normal_sum = 0.0, normal_squares = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double u = stream.NextUniform(-1.0, 3.0);
    ASSERT_GE(u, -1.0);
    ASSERT_LT(u, 3.0);
    sum += u;
    sum_squares += (u - 1.0) * (u - 1.0);
    const double z = stream.NextNormal();
    normal_sum += z;
    normal_squares += z * z;
  }
  EXPECT_NEAR(sum / kCount, 1.0, 5.0 * std::sqrt(16.0 / 12.0 / kCount));
  EXPECT_NEAR(sum_squares / kCount, 16.0 / 12.0, 0.02);
  EXPECT_NEAR(normal_sum / kCount, 0.0, 5.0 / std::sqrt(kCount));
  EXPECT_NEAR(normal_squares / kCount, 1.0, 5.0 * std::sqrt(2.0 / kCount));
}

TEST(RandomStream, IndexCoversItsRange) {
  RandomStream stream("index", "test");
  int counts[3] = {0, 0, 0};
  for (int i = 0; i < 3000; ++i) ++counts[stream.NextIndex(3)];
  for (int count : counts) EXPECT_NEAR(count, 1000, 5 * std::sqrt(3000 * 2.0 / 9.0));
}

}  // namespace
}  // namespace graspbench
