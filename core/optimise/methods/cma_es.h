#pragma once
/** @file
CMA-ES with the default parameters of N. Hansen, "The CMA evolution strategy: a tutorial",
arXiv:1604.00772 (2016): generations of 4 + floor(3 ln n), positive recombination weights,
cumulative step size, rank-one and rank-mu update. Samples outside the box are mirrored at its
faces. */

#include "core/optimise/methods/search.h"

namespace graspbench {

class CmaEs : public SearchMethod {
 public:
  CmaEs(const SearchSpace& space, RandomStream stream);
  std::vector<Individual> MakeGeneration() override;
  void Learn(const std::vector<Individual>& generation) override;

 private:
  SearchSpace space_;
  RandomStream stream_;
  int num_children_;
  Eigen::VectorXd weights_;  // of the best children, best first, sum 1
  double mu_eff_, c_sigma_, d_sigma_, c_c_, c_1_, c_mu_, expected_norm_;

  Eigen::VectorXd mean_;
  double sigma_;
  Eigen::MatrixXd C_;     // covariance / sigma^2
  Eigen::MatrixXd B_;     // its eigenvectors in columns
  Eigen::VectorXd axes_;  // square roots of its eigenvalues
  Eigen::VectorXd path_c_, path_sigma_;
  int num_learned_ = 0;
  std::vector<int> selected_;  // numbers of the children that made the mean
};

}  // namespace graspbench
