#include "human_study/statistics/reml.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/human_study/statistics/known_studies.h"

namespace graspbench {
namespace {

/** Synthetic persons with equal numbers of trials. Persons' means are `spread` times as far
apart as in the first layout; trials differ from their person's mean as there. */
std::vector<RemlGroup> MakeBalanced(double spread = 1.0) {
  const double values[4][3] = {{5.1, 6.0, 5.4}, {8.2, 7.1, 7.7}, {3.0, 4.4, 3.9}, {6.6, 6.1, 7.5}};
  std::vector<RemlGroup> groups;
  for (const auto& own : values) {
    RemlGroup group;
    group.x = group.z = Eigen::MatrixXd::Ones(3, 1);
    group.y = Eigen::Vector3d(own[0], own[1], own[2]);
    group.y.array() += (spread - 1.0) * group.y.mean();
    groups.push_back(group);
  }
  return groups;
}

/** Mean squares and mean of a balanced layout. */
struct MeanSquares {
  double grand = 0.0, within = 0.0, between = 0.0;

  explicit MeanSquares(const std::vector<RemlGroup>& groups) {
    for (const RemlGroup& group : groups) grand += group.y.mean() / 4.0;
    for (const RemlGroup& group : groups) {
      within += (group.y.array() - group.y.mean()).square().sum() / 8.0;
      between += 3.0 * std::pow(group.y.mean() - grand, 2) / 3.0;
    }
  }
};

// sigma^2 = MS_within, the persons' variance (MS_between - MS_within) / k, and the mean's standard
// error sqrt(MS_between / N) with n - 1 degrees of freedom (Searle, Casella and McCulloch 1992).
TEST(Reml, IsTheAnovaEstimateOfABalancedLayout) {
  const std::vector<RemlGroup> groups = MakeBalanced();
  const MeanSquares squares(groups);
  RemlStructure structure;
  structure.blocks = {1};
  const Answer<RemlFit> fit = FitReml(groups, structure);
  ASSERT_TRUE(fit) << fit.reason();
  EXPECT_NEAR(fit->sigma, std::sqrt(squares.within), 1e-8);
  EXPECT_NEAR(fit->sigma * std::abs(fit->theta(0)),
              std::sqrt((squares.between - squares.within) / 3.0), 1e-7);
  EXPECT_NEAR(fit->beta(0), squares.grand, 1e-12);
  EXPECT_NEAR(std::sqrt(fit->covariance(0, 0)), std::sqrt(squares.between / 12.0), 1e-8);
  EXPECT_NEAR(*fit->CalcDf(Eigen::VectorXd::Ones(1)), 3.0, 1e-5);
  const Answer<RemlFTest> test = fit->TestContrasts(Eigen::MatrixXd::Ones(1, 1));
  EXPECT_NEAR(test->f, squares.grand * squares.grand * 12.0 / squares.between, 1e-4);
}

// The search starts at a ratio of 1 between persons' and trials' standard deviations. Whatever the
// ratio is, it is found; where persons differ less than their trials, it is 0.
TEST(Reml, FindsEveryRatioOfPersonsToTrials) {
  RemlStructure structure;
  structure.blocks = {1};
  for (double spread = 0.05; spread < 20.0; spread *= 1.05) {
    const std::vector<RemlGroup> groups = MakeBalanced(spread);
    const MeanSquares squares(groups);
    const double ratio = std::sqrt(std::max(squares.between / squares.within - 1.0, 0.0) / 3.0);
    const Answer<RemlFit> fit = FitReml(groups, structure);
    ASSERT_TRUE(fit) << "spread " << spread << ", ratio " << ratio << ": " << fit.reason();
    EXPECT_NEAR(std::abs(fit->theta(0)), ratio, 1e-5) << spread;
  }
}

// lme4 1.1-31: lmer(y ~ ss * ps + (1 | id) + (0 + ss | id) + (0 + ps | id)). The way from the usual
// start ends on the saddle without a level of persons, where the criterion is -124.1789.
TEST(Reml, LeavesASaddle) {
  std::vector<RemlGroup> groups(6);
  for (const std::vector<std::string>& row : ReadKnownRows("saddle_study.csv")) {
    RemlGroup& group = groups[std::stoul(row[0])];
    const double size = std::stod(row[1]), pace = std::stod(row[2]);
    const Eigen::Index n = group.y.size();
    group.x.conservativeResize(n + 1, 4);
    group.z.conservativeResize(n + 1, 3);
    group.y.conservativeResize(n + 1);
    group.x.row(n) << 1.0, size, pace, size * pace;
    group.z.row(n) << 1.0, size, pace;
    group.y(n) = std::stod(row[3]);
  }
  RemlStructure structure;
  structure.blocks = {1, 1, 1};
  const Answer<RemlFit> fit = FitReml(groups, structure);
  ASSERT_TRUE(fit) << fit.reason();
  EXPECT_NEAR(fit->criterion, -126.537377519, 1e-6);
  EXPECT_NEAR(fit->sigma, 0.07264656302, 1e-7);
  EXPECT_NEAR(fit->sigma * std::abs(fit->theta(0)), 0.02550986690, 1e-6);
  EXPECT_NEAR(fit->sigma * std::abs(fit->theta(1)), 0.0, 1e-6);
  EXPECT_NEAR(fit->sigma * std::abs(fit->theta(2)), 0.01444129368, 1e-6);
  const Eigen::Vector4d beta(0.13501105535, -0.02411624980, -0.00575722202, -0.01218080576);
  EXPECT_NEAR((fit->beta - beta).norm(), 0.0, 1e-7);
}

TEST(Reml, GivesReasons) {
  std::vector<RemlGroup> groups = MakeBalanced();
  RemlStructure structure;
  structure.blocks = {1};
  for (RemlGroup& group : groups) group.x = Eigen::MatrixXd::Ones(3, 2);
  EXPECT_EQ(FitReml(groups, structure).reason(), "the fixed effects depend on each other");
  groups = MakeBalanced();
  for (RemlGroup& group : groups) group.z = Eigen::MatrixXd::Identity(3, 3);
  structure.blocks = {1, 1, 1};
  EXPECT_EQ(FitReml(groups, structure).reason(),
            "12 trials are no more than the fixed and random effects: no residual to compare with");
  groups = MakeBalanced();
  for (RemlGroup& group : groups) group.y.setConstant(group.y(0));
  structure.blocks = {1};
  EXPECT_EQ(FitReml(groups, structure).reason(),
            "the effects explain every trial: no residual to compare with");
}

}  // namespace
}  // namespace graspbench
