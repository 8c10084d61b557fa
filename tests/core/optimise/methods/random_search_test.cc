#include "core/optimise/methods/random_search.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

TEST(RandomSearch, FillsTheBoxEvenly) {
  SearchSpace space;
  space.lower = Eigen::Vector2d(-1.0, 10.0);
  space.upper = Eigen::Vector2d(3.0, 11.0);
  space.start = Eigen::Vector2d(0.0, 10.5);
  RandomSearch search(space, RandomStream("box", "test"));
  Eigen::Vector2d sum = Eigen::Vector2d::Zero(), squares = Eigen::Vector2d::Zero();
  int count = 0;
  while (count < 4000) {
    for (const Individual& individual : search.MakeGeneration()) {
      const Eigen::Array2d share =
          (individual.genome - space.lower).array() / (space.upper - space.lower).array();
      ASSERT_TRUE((share >= 0.0).all() && (share < 1.0).all());
      sum += share.matrix();
      squares += share.square().matrix();
      ++count;
    }
  }
  // Uniform: mean 1/2, mean square 1/3; four standard errors.
  const double root = std::sqrt(static_cast<double>(count));
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(sum[i] / count, 0.5, 4.0 * std::sqrt(1.0 / 12.0) / root);
    EXPECT_NEAR(squares[i] / count, 1.0 / 3.0, 4.0 * std::sqrt(4.0 / 45.0) / root);
  }
}

TEST(RandomSearch, TheStreamDecides) {
  SearchSpace space;
  space.lower = Eigen::VectorXd::Zero(1);
  space.upper = Eigen::VectorXd::Ones(1);
  space.start = Eigen::VectorXd::Zero(1);
  const auto first = [&](const char* id) {
    return RandomSearch(space, RandomStream(id, "test")).MakeGeneration().front().genome[0];
  };
  EXPECT_EQ(first("a"), first("a"));
  EXPECT_NE(first("a"), first("b"));
}

}  // namespace
}  // namespace graspbench
