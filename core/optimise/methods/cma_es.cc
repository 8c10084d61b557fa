/** @file
CMA-ES with the default parameters of N. Hansen, "The CMA evolution strategy: a tutorial",
arXiv:1604.00772 (2016): generations of 4 + floor(3 ln n), positive recombination weights,
cumulative step size, rank-one and rank-mu update. Samples outside the box are mirrored at its
faces. */

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/optimise/methods/search.h"

namespace graspbench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class CmaEs : public SearchMethod {
 public:
  CmaEs(const SearchSpace& space, RandomStream stream)
      : space_(space), stream_(stream), mean_(space.start), sigma_(space.step) {
    const double n = space.size();
    num_children_ = 4 + static_cast<int>(std::floor(3.0 * std::log(n)));
    weights_.resize(num_children_ / 2);
    for (Eigen::Index i = 0; i < weights_.size(); ++i) {
      weights_[i] = std::log(0.5 * (num_children_ + 1)) - std::log(static_cast<double>(i + 1));
    }
    weights_ /= weights_.sum();
    mu_eff_ = 1.0 / weights_.squaredNorm();
    c_sigma_ = (mu_eff_ + 2.0) / (n + mu_eff_ + 5.0);
    d_sigma_ = 1.0 + 2.0 * std::max(0.0, std::sqrt((mu_eff_ - 1.0) / (n + 1.0)) - 1.0) + c_sigma_;
    c_c_ = (4.0 + mu_eff_ / n) / (n + 4.0 + 2.0 * mu_eff_ / n);
    c_1_ = 2.0 / ((n + 1.3) * (n + 1.3) + mu_eff_);
    c_mu_ = std::min(1.0 - c_1_,
                     2.0 * (mu_eff_ - 2.0 + 1.0 / mu_eff_) / ((n + 2.0) * (n + 2.0) + mu_eff_));
    expected_norm_ = std::sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));
    const Eigen::Index size = space.size();
    C_ = B_ = MatrixXd::Identity(size, size);
    axes_ = VectorXd::Ones(size);
    path_c_ = path_sigma_ = VectorXd::Zero(size);
  }

  std::vector<Individual> MakeGeneration() override {
    std::vector<Individual> children(static_cast<size_t>(num_children_));
    for (Individual& child : children) {
      VectorXd z(space_.size());
      for (double& value : z) value = stream_.NextNormal();
      child.parents = selected_;
      child.genome = ReflectInto(space_, mean_ + sigma_ * (B_ * axes_.cwiseProduct(z)));
    }
    return children;
  }

  void Learn(const std::vector<Individual>& generation) override {
    if (generation.front().number == 0) return;  // the start is the first mean
    const double n = space_.size();
    std::vector<Individual> sorted = generation;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.fitness > b.fitness; });
    const VectorXd old_mean = mean_;
    MatrixXd rank_mu = MatrixXd::Zero(space_.size(), space_.size());
    mean_.setZero();
    selected_.clear();
    for (Eigen::Index i = 0; i < weights_.size(); ++i) {
      const Individual& child = sorted[i];
      const VectorXd y = (child.genome - old_mean) / sigma_;
      rank_mu += weights_[i] * y * y.transpose();
      mean_ += weights_[i] * child.genome;
      selected_.push_back(child.number);
    }
    const VectorXd shift = (mean_ - old_mean) / sigma_;
    const VectorXd whitened = B_ * (B_.transpose() * shift).cwiseQuotient(axes_);
    path_sigma_ = (1.0 - c_sigma_) * path_sigma_ +
                  std::sqrt(c_sigma_ * (2.0 - c_sigma_) * mu_eff_) * whitened;
    ++num_learned_;
    const double settled = std::sqrt(1.0 - std::pow(1.0 - c_sigma_, 2.0 * num_learned_));
    const bool is_short = path_sigma_.norm() / settled < (1.4 + 2.0 / (n + 1.0)) * expected_norm_;
    path_c_ *= 1.0 - c_c_;
    if (is_short) path_c_ += std::sqrt(c_c_ * (2.0 - c_c_) * mu_eff_) * shift;
    const double lost = is_short ? 0.0 : c_1_ * c_c_ * (2.0 - c_c_);
    C_ = (1.0 - c_1_ - c_mu_ + lost) * C_ + c_1_ * path_c_ * path_c_.transpose() + c_mu_ * rank_mu;
    sigma_ *= std::exp(c_sigma_ / d_sigma_ * (path_sigma_.norm() / expected_norm_ - 1.0));

    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(0.5 * (C_ + C_.transpose()));
    B_ = eigen.eigenvectors();
    constexpr double kSmallestEigenvalue = 1e-20;
    axes_ = eigen.eigenvalues().cwiseMax(kSmallestEigenvalue).cwiseSqrt();
  }

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

}  // namespace

std::unique_ptr<SearchMethod> MakeCmaEs(const SearchSpace& space, int, RandomStream stream) {
  return std::make_unique<CmaEs>(space, stream);
}

}  // namespace graspbench
