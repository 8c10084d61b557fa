#include "core/quality/linear_program.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "core/base/error.h"
#include "core/base/random.h"

namespace graspbench {
namespace {

// Dantzig's textbook example: maximise 3x + 5y, x <= 4, 2y <= 12, 3x + 2y <= 18; 36 at (2, 6).
TEST(LinearProgram, Textbook) {
  const Eigen::MatrixXd A = (Eigen::MatrixXd(3, 2) << 1, 0, 0, 2, 3, 2).finished();
  const LinearProgramResult result =
      SolveLinearProgram(A, Eigen::Vector3d(4, 12, 18), Eigen::Vector2d(3, 5));
  EXPECT_EQ(result.end, LinearProgramEnd::kOptimum);
  EXPECT_DOUBLE_EQ(result.value, 36.0);
  EXPECT_LT((result.x - Eigen::Vector2d(2, 6)).norm(), 1e-14);
}

// Beale's example, on which the usual pivot rule cycles for ever; optimum 1/20.
TEST(LinearProgram, BealesExampleDoesNotCycle) {
  const Eigen::MatrixXd A = (Eigen::MatrixXd(3, 4) << 0.25, -60.0, -0.04, 9.0,  //
                             0.5, -90.0, -0.02, 3.0,                            //
                             0.0, 0.0, 1.0, 0.0)
                                .finished();
  const LinearProgramResult result =
      SolveLinearProgram(A, Eigen::Vector3d(0, 0, 1), Eigen::Vector4d(0.75, -150.0, 0.02, -6.0));
  EXPECT_EQ(result.end, LinearProgramEnd::kOptimum);
  EXPECT_NEAR(result.value, 0.05, 1e-12);
}

TEST(LinearProgram, TellsWhenThereIsNoLimit) {
  const Eigen::MatrixXd A = (Eigen::MatrixXd(1, 2) << 1, -1).finished();
  EXPECT_EQ(SolveLinearProgram(A, Eigen::VectorXd::Ones(1), Eigen::Vector2d(1, 0)).end,
            LinearProgramEnd::kUnbounded);
}

// Brute force: of all corners (as many of the constraints met as there are variables) the best
// feasible one.
TEST(LinearProgram, AgreesWithTheBestCorner) {
  RandomStream stream("linear program", "corners");
  constexpr int kNumVariables = 4, kNumRows = 6, kNumPlanes = kNumRows + kNumVariables;
  for (int i = 0; i < 200; ++i) {
    Eigen::MatrixXd A(kNumRows, kNumVariables);
    for (double& value : A.reshaped()) value = stream.NextIndex(7) - 2.0;
    A.row(0).setOnes();  // bounded
    Eigen::VectorXd b(kNumRows), c(kNumVariables);
    for (double& value : b) value = stream.NextIndex(4);  // often 0: degenerate
    b[0] = 5.0;
    for (double& value : c) value = stream.NextIndex(9) - 3.0;

    Eigen::MatrixXd planes(kNumPlanes, kNumVariables);
    planes << A, -Eigen::MatrixXd::Identity(kNumVariables, kNumVariables);
    Eigen::VectorXd bounds(kNumPlanes);
    bounds << b, Eigen::VectorXd::Zero(kNumVariables);
    double best = 0.0;
    for (int mask = 0; mask < 1 << kNumPlanes; ++mask) {
      std::vector<int> rows;
      for (int row = 0; row < kNumPlanes; ++row) {
        if (mask >> row & 1) rows.push_back(row);
      }
      if (rows.size() != kNumVariables) continue;
      const Eigen::FullPivLU<Eigen::MatrixXd> lu(planes(rows, Eigen::all));
      if (!lu.isInvertible()) continue;
      const Eigen::VectorXd corner = lu.solve(bounds(rows));
      if (((planes * corner - bounds).array() <= 1e-9).all()) best = std::max(best, c.dot(corner));
    }

    const LinearProgramResult result = SolveLinearProgram(A, b, c);
    ASSERT_EQ(result.end, LinearProgramEnd::kOptimum);
    ASSERT_NEAR(result.value, best, 1e-9) << "program " << i;
    ASSERT_TRUE(((planes * result.x - bounds).array() <= 1e-9).all());
  }
}

// Variables that join after a solution lead where all of them at once do; the prices prove it: no
// variable gains, and b.prices is the value.
TEST(LinearProgram, GoesOnWithMoreVariables) {
  RandomStream stream("linear program", "columns");
  for (int i = 0; i < 50; ++i) {
    Eigen::MatrixXd A(6, 12);
    for (double& value : A.reshaped()) value = stream.NextNormal();
    A.row(0).setOnes();
    Eigen::VectorXd b = Eigen::VectorXd::Zero(6), c(12);
    b[0] = 1.0;
    b[3] = 0.5;
    for (double& value : c) value = stream.NextNormal();
    LinearProgram program(b);
    LinearProgramResult result;
    for (Eigen::Index j = 0; j < 12; ++j) {
      program.AddVariable(A.col(j), c[j]);
      result = program.Solve();
    }
    EXPECT_NEAR(result.value, SolveLinearProgram(A, b, c).value, 1e-10);
    EXPECT_NEAR(result.prices.dot(b), result.value, 1e-10);
    EXPECT_LE((c - A.transpose() * result.prices).maxCoeff(), 1e-10);
  }
}

// Friction of 1e100 once kept it going for ever. What comes out of such numbers is not looked at.
TEST(LinearProgram, EndsForNumbersThatAreFarApart) {
  RandomStream random("linear program", "far apart");
  for (int run = 0; run < 200; ++run) {
    const double scale = std::pow(10.0, random.NextUniform(0.0, 300.0));
    Eigen::MatrixXd A(12, 30);
    for (double& value : A.reshaped()) {
      value = random.NextNormal() * (random.NextUnit() < 0.3 ? scale : 1.0);
    }
    Eigen::VectorXd c(30);
    for (double& value : c) value = random.NextNormal();
    SolveLinearProgram(A, Eigen::VectorXd::Zero(12), c);
  }
}

}  // namespace
}  // namespace graspbench
