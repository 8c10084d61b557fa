#pragma once
/** @file
A small reaching study with known answers: largest grip aperture [mm] of 8 people for objects of
four sizes. Made up for these tests; the answers beside them come from R 4 (aov, car, ez, t.test,
friedman.test). */

#include <string>
#include <vector>

#include "human_study/statistics/measure_table.h"

namespace graspbench {

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

}  // namespace graspbench
