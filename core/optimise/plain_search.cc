#include "core/optimise/plain_search.h"

#include "core/base/error.h"

namespace graspbench {
namespace {

constexpr int kGeneration = 20;  // as many as the evolution strategy

int CalcPower(int base, int exponent) {
  int power = 1;
  for (int i = 0; i < exponent; ++i) power *= base;
  return power;
}

}  // namespace

Eigen::VectorXd DrawUniformPoint(const SearchSpace& space, RandomStream& stream) {
  Eigen::VectorXd point(space.size());
  for (Eigen::Index i = 0; i < point.size(); ++i) {
    point[i] = stream.NextUniform(space.lower[i], space.upper[i]);
  }
  return point;
}

std::vector<Individual> RandomSearch::MakeGeneration() {
  std::vector<Individual> generation(kGeneration);
  for (Individual& individual : generation) individual.genome = DrawUniformPoint(space_, stream_);
  return generation;
}

GridSearch::GridSearch(const SearchSpace& space, int num_points) : space_(space) {
  if (space.size() > 3) {
    throw Error(ErrorKind::kUnsupported,
                "a grid is possible for at most three joints, this digit has " +
                    std::to_string(space.size()));
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
  for (; next_ < num_points_ && generation.size() < kGeneration; ++next_) {
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

}  // namespace graspbench
