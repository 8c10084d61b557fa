#include "human_study/statistics/line_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/human_study/statistics/known_studies.h"

namespace graspbench {
namespace {

TEST(LineFit, AgreesWithNistNorris) {
  // NIST StRD, linear regression, Norris: calibration of ozone monitors; y, x.
  std::vector<double> x, y;
  for (const std::vector<std::string>& row : ReadKnownRows("nist_norris.csv")) {
    y.push_back(std::stod(row[0]));
    x.push_back(std::stod(row[1]));
  }
  const Answer<LineFit> fit = FitLine(x, y);
  ASSERT_TRUE(fit) << fit.reason();
  EXPECT_NEAR(fit->intercept, -0.262323073774029, 1e-13);
  EXPECT_NEAR(fit->slope, 1.00211681802045, 1e-14);
  EXPECT_NEAR(*fit->intercept_error, 0.232818234301152, 1e-14);
  EXPECT_NEAR(*fit->slope_error, 0.429796848199937e-3, 1e-17);
  EXPECT_NEAR(*fit->residual_sd, 0.884796396144373, 1e-13);
  EXPECT_NEAR(*fit->r_squared, 0.999993745883712, 1e-14);
}

TEST(LineFit, GivesReasonsAndLeavesOutWhatTwoPointsCannotTell) {
  EXPECT_EQ(FitLine({1}, {2}).reason(), "1 point; expected 2 or more");
  EXPECT_EQ(FitLine({3, 3}, {2, 4}).reason(), "all 2 points have the same x");
  EXPECT_EQ(FitLine({1, NAN}, {2, 4}).reason(), "a value is not finite");
  const auto two = FitLine({1, 2}, {5, 5});
  ASSERT_TRUE(two);
  EXPECT_EQ(two->slope, 0.0);
  EXPECT_FALSE(two->slope_error || two->residual_sd || two->r_squared);
}

TEST(PersonSlopes, AgreeWithR) {
  const auto points = ListPoints(MakeReachTable(), 0);
  ASSERT_TRUE(points) << points.reason();
  const PersonSlopes slopes = CalcPersonSlopes(*points, 0.82);
  ASSERT_EQ(slopes.persons.size(), 8u);
  EXPECT_EQ(slopes.persons[3].person, "P4");
  EXPECT_NEAR(slopes.persons[3].line->slope, 1.046666666667, 1e-12);
  ASSERT_TRUE(slopes.test) << slopes.test.reason();
  EXPECT_NEAR(slopes.test->mean, 0.8258333, 5e-8);
  EXPECT_NEAR(slopes.test->standard_deviation, 0.1593016, 5e-8);
  EXPECT_NEAR(slopes.test->t, 0.1035719, 5e-8);
  EXPECT_NEAR(slopes.test->p, 0.920414, 5e-7);
}

TEST(PersonSlopes, APersonWithoutASlopeIsNamed) {
  std::vector<PersonPoint> points = *ListPoints(MakeReachTable(), 0);
  points.push_back({"late", 30, 61});
  const PersonSlopes slopes = CalcPersonSlopes(points, 0.82);
  EXPECT_EQ(slopes.persons.back().person, "late");
  EXPECT_EQ(slopes.persons.back().line.reason(), "1 point; expected 2 or more");
  EXPECT_EQ(slopes.test->count, 8);
  EXPECT_EQ(CalcPersonSlopes({}, 0.0).test.reason(), "0 persons with a value; expected 2 or more");
}

TEST(ListPoints, TakesTheNumberOfTheLevelAndSkipsTheMissing) {
  MeasureTable table;
  table.factors = {{"side", {"left", "right"}, {}, ""},
                   {"size", {"s", "l"}, {0.03, 0.06}, ""},
                   {"mass", {"a", "b", "c"}, {1, 2, 3}, ""}};
  table.rows = {{"P", "1", {"left", "l", "c"}, 5.0},
                {"P", "2", {"right", "s", "b"}, std::nan("")},
                {"P", "3", {"right", "s", "b"}, 7.0}};
  const auto sizes = ListPoints(table, 1), masses = ListPoints(table, 2);
  ASSERT_EQ(sizes->size(), 2u);
  EXPECT_EQ((*sizes)[0].x, 0.06);
  EXPECT_EQ((*sizes)[1].x, 0.03);
  EXPECT_EQ((*masses)[0].x, 3.0);
  EXPECT_EQ((*masses)[1].y, 7.0);
  EXPECT_EQ(ListPoints(table, 0).reason(), "the levels of factor \"side\" have no numbers");
}

}  // namespace
}  // namespace graspbench
