#include "core/quality/affine_basis.h"

#include <cmath>

namespace graspbench {

std::vector<int> FindAffineBasis(const Eigen::Ref<const Eigen::MatrixXd>& points) {
  if (points.cols() == 0) return {};
  Eigen::Index index = 0;
  const double scale = std::sqrt(points.colwise().squaredNorm().maxCoeff(&index));
  std::vector<int> basis{static_cast<int>(index)};
  Eigen::MatrixXd rest = points.colwise() - points.col(index);
  while (static_cast<Eigen::Index>(basis.size()) <= points.rows()) {
    const double distance = std::sqrt(rest.colwise().squaredNorm().maxCoeff(&index));
    if (!(distance > kNegligibleShare * scale)) break;
    basis.push_back(static_cast<int>(index));
    const Eigen::VectorXd direction = rest.col(index) / distance;
    rest -= direction * (direction.transpose() * rest).eval();
  }
  return basis;
}

}  // namespace graspbench
