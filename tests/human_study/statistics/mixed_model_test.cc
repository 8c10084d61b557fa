#include "human_study/statistics/mixed_model.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/base/units.h"
#include "tests/human_study/statistics/reach_study.h"
#include "tests/human_study/statistics/sleep_study.h"

namespace graspbench {
namespace {

// Answers of R 4.2 with lme4 1.1-31 and lmerTest 3.1-3, y ~ x + (x | person), REML.

TEST(MixedModel, AgreesWithLme4OnTheSleepStudy) {
  const Answer<MixedModel> model = FitMixedModel(MakeSleepStudy());
  ASSERT_TRUE(model) << model.reason();
  EXPECT_EQ(model->num_persons, 18);
  EXPECT_EQ(model->num_observations, 180);
  EXPECT_NEAR(model->reml_criterion, 1743.62827196, 1e-7);
  EXPECT_NEAR(model->intercept.estimate, 251.4051048485, 1e-9);
  EXPECT_NEAR(model->intercept.standard_error, 6.82455577628, 1e-4);
  EXPECT_NEAR(model->slope.estimate, 10.4672859596, 1e-9);
  EXPECT_NEAR(model->slope.standard_error, 1.54578893243, 1e-5);
  EXPECT_NEAR(model->slope.t, 6.77148460569, 1e-4);
  EXPECT_NEAR(model->intercept_sd, 24.7404476, 1e-3);
  EXPECT_NEAR(model->slope_sd, 5.9221333, 1e-4);
  EXPECT_NEAR(*model->correlation, 0.0655513, 1e-4);
  EXPECT_NEAR(model->residual_sd, 25.5918159, 1e-4);
  EXPECT_FALSE(model->is_singular);
  ASSERT_TRUE(model->slope.test) << model->slope.test.reason();
  EXPECT_NEAR(model->intercept.test->df, 17.0, 1e-4);
  EXPECT_NEAR(model->slope.test->df, 17.0, 1e-4);
  EXPECT_NEAR(model->slope.test->p / 3.26379e-06, 1.0, 1e-3);
  EXPECT_EQ(model->persons[1].person, "309");
  EXPECT_NEAR(model->persons[1].intercept, 251.4051048 - 40.39857692, 1e-3);
  EXPECT_NEAR(model->persons[1].slope, 10.46728596 - 8.61970318, 1e-4);
}

TEST(MixedModel, IsTheClosedFormWhenAllPersonsHaveTheSameX) {
  // Then sigma^2 is the pooled variance about the persons' own lines, and Psi the covariance of
  // their coefficients less sigma^2 (X^T X)^-1; standard errors are those of the mean coefficients.
  for (const auto& [points, num_trials] :
       {std::pair{MakeSleepStudy(), 10}, std::pair{*ListPoints(MakeReachTable(), 0), 4}}) {
    const PersonSlopes lines = CalcPersonSlopes(points, 0.0);
    const auto n = static_cast<Eigen::Index>(lines.persons.size());
    Eigen::MatrixXd coefficients(n, 2);
    double sigma2 = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const LineFit& line = *lines.persons[static_cast<size_t>(i)].line;
      coefficients.row(i) << line.intercept, line.slope;
      sigma2 += *line.residual_sd * *line.residual_sd / static_cast<double>(n);
    }
    Eigen::MatrixXd x(num_trials, 2);
    for (int t = 0; t < num_trials; ++t) {
      x.row(t) << 1.0, points[static_cast<size_t>(t)].x;
    }
    const Eigen::MatrixXd deviations = coefficients.rowwise() - coefficients.colwise().mean();
    const Eigen::Matrix2d between =
        deviations.transpose() * deviations / static_cast<double>(n - 1);
    const Eigen::Matrix2d psi = between - sigma2 * (x.transpose() * x).inverse();

    const Answer<MixedModel> model = FitMixedModel(points);
    ASSERT_TRUE(model) << model.reason();
    EXPECT_NEAR(model->residual_sd / std::sqrt(sigma2), 1.0, 1e-8);
    EXPECT_NEAR(model->intercept_sd / std::sqrt(psi(0, 0)), 1.0, 1e-7);
    EXPECT_NEAR(model->slope_sd / std::sqrt(psi(1, 1)), 1.0, 1e-7);
    EXPECT_NEAR(*model->correlation, psi(1, 0) / std::sqrt(psi(0, 0) * psi(1, 1)), 1e-7);
    EXPECT_NEAR(model->slope.estimate, lines.test->mean, 1e-10);
    EXPECT_NEAR(model->slope.t / lines.test->t, 1.0, 1e-8);
    EXPECT_NEAR(model->slope.test->df, static_cast<double>(n - 1), 1e-5);
  }
}

std::vector<PersonPoint> MakeUnbalanced() {
  std::vector<PersonPoint> kept;
  const std::vector<PersonPoint> all = MakeSleepStudy();
  for (size_t i = 0; i < all.size(); ++i) {
    const size_t person = i / 10 + 1, day = i % 10;
    if ((person % 3 == 1 && day > 6) || (person % 4 == 2 && day < 4)) continue;
    kept.push_back(all[i]);
  }
  return kept;
}

TEST(MixedModel, AgreesWithLme4WhenPersonsHaveDifferentNumbersOfTrials) {
  const Answer<MixedModel> model = FitMixedModel(MakeUnbalanced());
  ASSERT_TRUE(model) << model.reason();
  EXPECT_EQ(model->num_observations, 142);
  EXPECT_NEAR(model->reml_criterion, 1367.33068796, 1e-7);
  EXPECT_NEAR(model->intercept.estimate, 256.67865228, 1e-4);
  EXPECT_NEAR(model->intercept.standard_error, 9.85155176, 1e-4);
  EXPECT_NEAR(model->slope.estimate, 9.45481611, 1e-5);
  EXPECT_NEAR(model->slope.standard_error, 2.09214435, 1e-5);
  EXPECT_NEAR(model->intercept_sd, 36.099328, 1e-3);
  EXPECT_NEAR(model->slope_sd, 7.912814, 1e-4);
  EXPECT_NEAR(*model->correlation, -0.390735, 1e-4);
  EXPECT_NEAR(model->residual_sd, 23.149128, 1e-4);
  EXPECT_NEAR(model->intercept.test->df, 10.38927, 1e-3);
  EXPECT_NEAR(model->slope.test->df, 14.56317, 1e-3);
  EXPECT_NEAR(model->slope.test->p / 4.37406e-04, 1.0, 1e-3);
}

TEST(MixedModel, AgreesWithLme4OnTheReachingStudy) {
  const Answer<MixedModel> model = FitMixedModel(*ListPoints(MakeReachTable(), 0));
  ASSERT_TRUE(model) << model.reason();
  EXPECT_NEAR(model->reml_criterion, 163.162136485, 1e-8);
  EXPECT_NEAR(model->intercept.estimate, 36.8625, 1e-9);
  EXPECT_NEAR(model->slope.estimate, 0.8258333333, 1e-10);
  EXPECT_NEAR(model->slope.standard_error, 0.05632156, 1e-6);
  EXPECT_NEAR(model->intercept_sd, 8.95817, 1e-4);
  EXPECT_NEAR(model->slope_sd, 0.15163643, 1e-6);
  EXPECT_NEAR(*model->correlation, -0.9363732, 1e-6);
  EXPECT_NEAR(model->residual_sd, 1.637453, 1e-5);
  EXPECT_NEAR(model->slope.test->df, 7.0, 1e-4);
}

std::vector<PersonPoint> MakeParallel() {
  // Six nearly parallel lines; made up.
  const double y[6][5] = {{10.1, 11.9, 14.2, 15.8, 18.1}, {12.2, 13.8, 16.1, 18.0, 19.7},
                          {9.0, 11.2, 12.8, 15.1, 17.0},  {11.1, 12.8, 15.2, 17.1, 18.9},
                          {10.4, 12.5, 14.4, 16.7, 18.4}, {8.8, 10.6, 12.9, 14.7, 16.8}};
  std::vector<PersonPoint> points;
  for (int p = 0; p < 6; ++p) {
    for (int x = 0; x < 5; ++x) points.push_back({std::to_string(p), 1.0 * x, y[p][x]});
  }
  return points;
}

TEST(MixedModel, CallsASingularFitSingular) {
  const Answer<MixedModel> model = FitMixedModel(MakeParallel());
  ASSERT_TRUE(model) << model.reason();
  EXPECT_TRUE(model->is_singular);
  EXPECT_NEAR(model->reml_criterion, 11.368127411, 1e-7);
  EXPECT_NEAR(model->intercept_sd, 1.25740943, 1e-4);
  EXPECT_NEAR(model->slope_sd, 0.0236434, 1e-5);
  EXPECT_NEAR(*model->correlation, -1.0, 1e-6);
  EXPECT_NEAR(model->slope.standard_error, 0.02229395, 1e-6);
  EXPECT_EQ(model->slope.test.reason(),
            "singular fit: a variance between persons is zero or their correlation is 1");
}

/** The criterion by dense algebra, with sigma not profiled out. */
double CalcDense(const std::vector<PersonPoint>& points, const Eigen::Matrix2d& psi,
                 double sigma2) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd v = Eigen::MatrixXd::Identity(n, n) * sigma2, x(n, 2);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const PersonPoint& a = points[static_cast<size_t>(i)];
    x.row(i) << 1.0, a.x;
    y(i) = a.y;
    for (Eigen::Index k = 0; k < n; ++k) {
      const PersonPoint& b = points[static_cast<size_t>(k)];
      if (a.person == b.person) {
        v(i, k) += Eigen::RowVector2d(1.0, a.x) * psi * Eigen::Vector2d(1.0, b.x);
      }
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> llt(v);
  const Eigen::Matrix2d c = x.transpose() * llt.solve(x);
  const Eigen::VectorXd r = y - x * c.inverse() * (x.transpose() * llt.solve(y));
  const double log_det = 2.0 * llt.matrixL().toDenseMatrix().diagonal().array().log().sum();
  return log_det + std::log(c.determinant()) + r.dot(llt.solve(r)) +
         static_cast<double>(n - 2) * std::log(2.0 * kPi);
}

TEST(MixedModel, IsTheMinimumOfTheDenseCriterion) {
  for (const auto& points : {MakeUnbalanced(), *ListPoints(MakeReachTable(), 0), MakeParallel()}) {
    const Answer<MixedModel> model = FitMixedModel(points);
    ASSERT_TRUE(model);
    const auto calc_near = [&](double a, double b, double turn, double s) {
      const double sd_0 = model->intercept_sd * (1.0 + a), sd_1 = model->slope_sd * (1.0 + b);
      const double r =
          std::tanh(std::atanh(std::clamp(*model->correlation, -1.0 + 1e-12, 1.0 - 1e-12)) + turn);
      Eigen::Matrix2d psi;
      psi << sd_0 * sd_0, r * sd_0 * sd_1, r * sd_0 * sd_1, sd_1 * sd_1;
      return CalcDense(points, psi, std::pow(model->residual_sd * (1.0 + s), 2));
    };
    const double at_optimum = calc_near(0, 0, 0, 0);
    EXPECT_NEAR(at_optimum, model->reml_criterion, 1e-7);
    for (double step : {-0.2, -1e-3, 1e-3, 0.2}) {
      EXPECT_GT(calc_near(step, 0, 0, 0), at_optimum);
      EXPECT_GT(calc_near(0, step, 0, 0), at_optimum);
      EXPECT_GT(calc_near(0, 0, 0, step), at_optimum);
      if (!model->is_singular) {
        EXPECT_GT(calc_near(0, 0, step, 0), at_optimum);
      }
    }
  }
}

TEST(MixedModel, FollowsAChangeOfUnitAndOrigin) {
  const Answer<MixedModel> plain = FitMixedModel(MakeUnbalanced());
  std::vector<PersonPoint> points = MakeUnbalanced();
  for (PersonPoint& point : points) {
    point.x = 0.001 * point.x + 5.0;
    point.y = 1000.0 * point.y - 7.0;
  }
  const Answer<MixedModel> changed = FitMixedModel(points);
  ASSERT_TRUE(changed);
  EXPECT_NEAR(changed->slope.estimate / (1e6 * plain->slope.estimate), 1.0, 1e-8);
  EXPECT_NEAR(changed->slope.standard_error / (1e6 * plain->slope.standard_error), 1.0, 1e-6);
  EXPECT_NEAR(changed->slope_sd / (1e6 * plain->slope_sd), 1.0, 1e-6);
  EXPECT_NEAR(changed->residual_sd / (1e3 * plain->residual_sd), 1.0, 1e-6);
  EXPECT_NEAR(changed->slope.test->df, plain->slope.test->df, 1e-3);
}

TEST(MixedModel, GivesReasons) {
  EXPECT_EQ(FitMixedModel({}).reason(), "no observations");
  EXPECT_EQ(FitMixedModel({{"P", 1, 2}, {"P", 2, 3}, {"P", 3, 5}}).reason(),
            "1 person; expected 2 or more");
  EXPECT_EQ(FitMixedModel({{"P", 1, 2}, {"Q", 2, 3}, {"P", 3, 5}, {"Q", 4, 4}}).reason(),
            "4 observations of 2 persons; expected more than two a person");
  EXPECT_EQ(
      FitMixedModel({{"P", 1, 2}, {"Q", 1, 3}, {"P", 1, 5}, {"Q", 1, 4}, {"P", 1, 1}}).reason(),
      "all observations have the same x");
  EXPECT_EQ(FitMixedModel({{"P", 1, NAN}}).reason(), "person \"P\": a value is not finite");
  std::vector<PersonPoint> exact;
  for (int x = 0; x < 4; ++x) {
    exact.push_back({"P", 0.1 * x, 0.3 * x});
    exact.push_back({"Q", 0.1 * x, 0.7 + 0.2 * x});
  }
  EXPECT_EQ(FitMixedModel(exact).reason(),
            "every person's points lie on a line: no residual to compare with");
}

}  // namespace
}  // namespace graspbench
