#pragma once
/** @file
Small studies with known answers of R and others, some of them as tables in r/.

The reaching study: largest grip aperture [mm] of 8 people for objects of four sizes, made up for
these tests; the answers beside them come from R 4 (aov, car, ez, t.test, friedman.test).

The sleep study: mean reaction time [ms] of 18 people on ten days of sleep deprivation, days 0 to 9:
G. Belenky et al., "Patterns of performance degradation and restoration during sleep restriction and
subsequent recovery", J. Sleep Res. 12 (2003), as published with R's package lme4 (sleepstudy).

The saddle study: made-up shares of 66 trials of six persons, two sizes and two paces (as +1 and -1),
one condition of two persons empty: the likelihood of separate variances of persons has a saddle
where that of their level is 0. */

#include <sstream>
#include <string>
#include <vector>

#include "core/base/files/files.h"
#include "human_study/statistics/line_fit.h"

namespace graspbench {

/** The rows of a table of r/, without its heading. */
inline std::vector<std::vector<std::string>> ReadKnownRows(const std::string& name) {
  std::istringstream text(ReadFile(FindDataRoot() / "tests/human_study/statistics/r" / name));
  std::vector<std::vector<std::string>> rows;
  std::string line, cell;
  std::getline(text, line);
  while (std::getline(text, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    while (std::getline(cells, cell, ',')) rows.back().push_back(cell);
  }
  return rows;
}

inline Eigen::MatrixXd MakeReachMeans() {
  Eigen::MatrixXd means(8, 4);
  means << 62, 74, 85, 99,  //
      58, 71, 86, 97,       //
      66, 75, 83, 92,       //
      60, 77, 90, 108,      //
      71, 80, 92, 101,      //
      55, 69, 80, 98,       //
      64, 73, 88, 95,       //
      59, 72, 84, 103;
  return means;
}

inline MeasureTable MakeReachTable() {
  MeasureTable table;
  table.measure = "aperture_mm";
  table.unit = "mm";
  table.factors = {{"size", {"30", "45", "60", "75"}, {30, 45, 60, 75}, "width of the object"}};
  const Eigen::MatrixXd means = MakeReachMeans();
  for (Eigen::Index p = 0; p < means.rows(); ++p) {
    for (Eigen::Index c = 0; c < means.cols(); ++c) {
      table.rows.push_back({"P" + std::to_string(p + 1),
                            std::to_string(c + 1),
                            {table.factors[0].levels[static_cast<size_t>(c)]},
                            means(p, c)});
    }
  }
  return table;
}

inline std::vector<PersonPoint> MakeSleepStudy() {
  std::vector<PersonPoint> points;
  for (const auto& row : ReadKnownRows("sleep_study.csv")) {
    points.push_back({row[0], std::stod(row[1]), std::stod(row[2])});
  }
  return points;
}

}  // namespace graspbench
