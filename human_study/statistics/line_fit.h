#pragma once
/** @file
Least-squares lines y = intercept + slope x, for example how much wider the hand opens per metre of
object size. Lines are fitted per person; the persons' slopes form one sample, tested against a
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
  /** Unset for two points, as are the standard errors. */
  std::optional<double> residual_sd;
  std::optional<double> intercept_error;  ///< standard error
  std::optional<double> slope_error;
  std::optional<double> r_squared;  ///< unset when all y are equal
};

/** @pre equal sizes. No answer below two points, when all x are equal or a value is not finite. */
Answer<LineFit> FitLine(const std::vector<double>& x, const std::vector<double>& y);

struct PersonPoint {
  std::string person;
  double x = 0.0;
  double y = 0.0;
};

/** Lists all trials with a value as points; x is the level's number. No answer when the factor has
no numbers, or for the reasons of CalcCellMeans. @pre factor < table.factors.size(). */
Answer<std::vector<PersonPoint>> ListPoints(const MeasureTable& table, size_t factor);

struct PersonLine {
  std::string person;
  Answer<LineFit> line;
};

struct PersonSlopes {
  std::vector<PersonLine> persons;  ///< in order of appearance
  Answer<TTest> test;               ///< of all slopes found
};

PersonSlopes CalcPersonSlopes(const std::vector<PersonPoint>& points, double reference);

}  // namespace graspbench
