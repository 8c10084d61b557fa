#include "core/physics/cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <string>

#include "core/base/random.h"

namespace graspbench {
namespace {

using Eigen::MatrixXd;

MatrixXd MakePositiveDefinite(int n) {
  RandomStream random("cholesky", std::to_string(n));
  MatrixXd A(n, n);
  for (int i = 0; i < A.size(); ++i) A.data()[i] = random.NextUniform(-1.0, 1.0);
  return A * A.transpose() + 0.1 * MatrixXd::Identity(n, n);
}

TEST(FactorCholesky, GivesTheMatrixBackAtEverySize) {
  for (int n = 1; n <= 70; ++n) {
    const MatrixXd H = MakePositiveDefinite(n);
    MatrixXd factored = H;
    factored.triangularView<Eigen::StrictlyUpper>().setConstant(1e300);  // is not read
    ASSERT_TRUE(FactorCholesky(factored)) << n;
    const MatrixXd L = factored.triangularView<Eigen::Lower>();
    EXPECT_LT((L * L.transpose() - H).cwiseAbs().maxCoeff(), 1e-13 * n * H.norm()) << n;
  }
}

// 21 unknowns has the TUM Hand with an object, 32 the Shadow Hand.
TEST(FactorCholesky, IsEigensToTheLastBit) {
  for (const int n : {9, 21, 31, 32, 40}) {
    const MatrixXd H = MakePositiveDefinite(n);
    MatrixXd factored = H;
    ASSERT_TRUE(FactorCholesky(factored));
    const MatrixXd L = factored.triangularView<Eigen::Lower>();
    const MatrixXd expected = H.llt().matrixL();
    EXPECT_EQ((L - expected).cwiseAbs().maxCoeff(), 0.0) << n;
  }
}

TEST(FactorCholesky, RefusesWhatIsNotPositiveDefinite) {
  for (const int n : {1, 7, 32, 40}) {
    MatrixXd H = MakePositiveDefinite(n);
    H(n - 1, n - 1) = -1.0;
    EXPECT_FALSE(FactorCholesky(H)) << n;
  }
}

}  // namespace
}  // namespace graspbench
