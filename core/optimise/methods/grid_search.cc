#include "core/optimise/methods/grid_search.h"

#include "core/base/error.h"

namespace graspbench {
namespace {

int CalcPower(int base, int exponent) {
  int power = 1;
  for (int i = 0; i < exponent; ++i) power *= base;
  return power;
}

}  // namespace

GridSearch::GridSearch(const SearchSpace& space, int num_points) : space_(space) {
  if (space.size() > 3) {
    throw Error(ErrorKind::kUnsupported,
                "a grid is possible for at most three coordinates, this search has " +
                    std::to_string(space.size()) + "; choose another method");
  }
  points_each_ = 1;
  while (CalcPower(points_each_ + 1, space.size()) <= num_points) ++points_each_;
  if (points_each_ < 2) {
    throw Error(
        ErrorKind::kUnsupported,
        "a grid needs at least " + std::to_string(CalcPower(2, space.size()) + 1) + " evaluations");
  }
  num_points_ = CalcPower(points_each_, space.size());
}

std::vector<Individual> GridSearch::MakeGeneration() {
  std::vector<Individual> generation;
  for (; next_ < num_points_ && generation.size() < kPlainGeneration; ++next_) {
    Individual individual;
    individual.genome = space_.lower;
    for (int i = 0, rest = next_; i < space_.size(); ++i, rest /= points_each_) {
      individual.genome[i] +=
          (space_.upper[i] - space_.lower[i]) * (rest % points_each_) / (points_each_ - 1);
    }
    generation.push_back(individual);
  }
  return generation;
}

SearchMethodRow GridSearchRow() {
  return {"grid", [](const SearchSpace& space, int num_evaluations, RandomStream) {
            return std::unique_ptr<SearchMethod>(
                std::make_unique<GridSearch>(space, num_evaluations - 1));  // after the start
          }};
}

}  // namespace graspbench
