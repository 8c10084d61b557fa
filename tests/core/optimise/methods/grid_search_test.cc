#include "core/optimise/methods/grid_search.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "core/base/error.h"

namespace graspbench {
namespace {

SearchSpace MakeBox(int size) {
  SearchSpace space;
  space.lower = Eigen::VectorXd::Constant(size, -1.0);
  space.upper = Eigen::VectorXd::Constant(size, 3.0);
  space.start = Eigen::VectorXd::Zero(size);
  return space;
}

TEST(GridSearch, GivesEveryPointOfTheLatticeOnceAndThenNoMore) {
  // 5^2 <= 30 < 6^2: five points each, one apart.
  GridSearch search(MakeBox(2), 30);
  std::set<std::array<double, 2>> points;
  size_t count = 0;
  for (auto generation = search.MakeGeneration(); !generation.empty();
       generation = search.MakeGeneration()) {
    for (const Individual& individual : generation) {
      points.insert({individual.genome[0], individual.genome[1]});
      ++count;
    }
  }
  std::set<std::array<double, 2>> lattice;
  for (int i = -1; i <= 3; ++i) {
    for (int j = -1; j <= 3; ++j) lattice.insert({double(i), double(j)});
  }
  EXPECT_EQ(points, lattice);
  EXPECT_EQ(count, lattice.size());
}

TEST(GridSearch, RefusesWhatNoGridCanBeMadeOf) {
  for (const auto& [size, num_points] : {std::pair{4, 1000}, std::pair{3, 7}}) {
    try {
      GridSearch(MakeBox(size), num_points);
      FAIL() << size;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kUnsupported);
    }
  }
  EXPECT_EQ(GridSearch(MakeBox(3), 8).MakeGeneration().size(), 8u) << "the corners";
}

}  // namespace
}  // namespace graspbench
