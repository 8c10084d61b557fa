#pragma once
/** @file
A search over a regular grid, for few coordinates. */

#include "core/optimise/methods/search.h"

namespace graspbench {

/** As many equal distances in each coordinate as `num_points` allow, faces included. */
class GridSearch : public SearchMethod {
 public:
  /** @throws Error(kUnsupported) for more than three coordinates, or for fewer than two points in
  each. */
  GridSearch(const SearchSpace& space, int num_points);
  /** Empty when the whole grid was given. */
  std::vector<Individual> MakeGeneration() override;
  void Learn(const std::vector<Individual>&) override {}

 private:
  SearchSpace space_;
  int points_each_ = 0;
  int num_points_ = 1;
  int next_ = 0;
};

}  // namespace graspbench
