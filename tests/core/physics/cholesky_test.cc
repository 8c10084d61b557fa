#include "core/physics/cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
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

/** Fingers that meet in the palm only: blocks along the diagonal, and rows that are full below. */
MatrixXd MakeHandLike(int num_fingers, int num_joints, int num_others) {
  MatrixXd H = MakePositiveDefinite(num_fingers * num_joints + num_others);
  for (int a = 0; a < num_fingers * num_joints; ++a) {
    for (int b = 0; b < num_fingers * num_joints; ++b) {
      if (a / num_joints != b / num_joints) H(a, b) = 0.0;
    }
  }
  return H + 4.0 * static_cast<double>(H.rows()) * MatrixXd::Identity(H.rows(), H.rows());
}

TEST(FactorCholesky, SkipsZerosWithoutAChangeOfABit) {
  for (const auto& [fingers, joints, others] : {std::array{3, 3, 12}, {5, 4, 12}, {4, 7, 12}}) {
    const MatrixXd H = MakeHandLike(fingers, joints, others);
    MatrixXd factored = H;
    ASSERT_TRUE(FactorCholesky(factored));
    const MatrixXd L = factored.triangularView<Eigen::Lower>();
    const MatrixXd expected = H.llt().matrixL();
    EXPECT_EQ((L - expected).cwiseAbs().maxCoeff(), 0.0) << fingers;
    EXPECT_LT((L * L.transpose() - H).cwiseAbs().maxCoeff(), 1e-12) << fingers;
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
