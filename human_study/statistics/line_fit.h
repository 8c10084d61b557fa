#pragma once
/** @file
Straight lines y = intercept + slope x by least squares, and a line for each person: how much wider
the hand opens per metre of object. The persons' slopes are then one sample, tested against a
reference such as 0 or 1. */

#include <optional>
#include <string>
#include <vector>

#include "human_study/statistics/location_tests.h"
#include "human_study/statistics/measure_table.h"

namespace graspbench {

struct LineFit {
  int count = 0;
  double intercept = 0.0;
  double slope = 0.0;
  /** None for two points, as the standard errors. */
  std::optional<double> residual_sd;
  std::optional<double> intercept_error;  ///< standard error
  std::optional<double> slope_error;
  std::optional<double> r_squared;  ///< none when all y are equal
};

/** @pre equal sizes. No answer below two points, when all x are equal or a value is not finite. */
Answer<LineFit> FitLine(const std::vector<double>& x, const std::vector<double>& y);

struct PersonPoint {
  std::string person;
  double x = 0.0;
  double y = 0.0;
};

/** Every trial with a value as a point; x is the level's number. No answer when the factor has no
numbers, or with the faults of CalcCellMeans. @pre factor < table.factors.size(). */
Answer<std::vector<PersonPoint>> ListPoints(const MeasureTable& table, size_t factor);

struct PersonLine {
  std::string person;
  Answer<LineFit> line;
};

struct PersonSlopes {
  std::vector<PersonLine> persons;  ///< in order of appearance
  Answer<TTest> test;               ///< of the slopes of those who have one
};

PersonSlopes CalcPersonSlopes(const std::vector<PersonPoint>& points, double reference);

}  // namespace graspbench
