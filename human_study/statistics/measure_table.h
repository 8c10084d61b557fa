#pragma once
/** @file
Input of all statistics of a study: one measure in long ("tidy") form, one row per trial; and its
mean per person and condition, the unit of analysis of a repeated-measures design. Factors vary
within each person; groups (patients, controls) are factors between persons. */

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/statistics/answer.h"

namespace graspbench {

/** A variable that is varied within each person, or that describes a person. */
struct Factor {
  std::string name;                 ///< "object_width"
  std::vector<std::string> levels;  ///< in the order of tables and figures
  /** The values of levels that are quantities (SI), one per level; else empty. */
  std::vector<double> numbers;
  std::string description;
};

struct Observation {
  std::string person;
  std::string trial;                                        ///< label; only passed on
  std::vector<std::string> levels;                          ///< one per factor
  double value = std::numeric_limits<double>::quiet_NaN();  ///< NaN: missing
  std::vector<std::string> groups = {};                     ///< one per group factor
  std::string session = {};                                 ///< empty: not stated
};

/** Hypothesis about a measure, set before the data were seen. */
struct Hypothesis {
  std::string measure;
  double slope = 0.0;         ///< [measure's unit per the factor's]
  double equal_within = NAN;  ///< [measure's unit]; NaN: equivalence is not tested
};

struct MeasureTable {
  std::string measure;  ///< "grasp_forming_time_s"
  std::string unit;     ///< "s"; empty for a ratio
  std::string description;
  std::vector<Factor> factors;
  std::vector<Observation> rows;
  std::vector<Factor> groups;         ///< factors between persons
  std::vector<std::string> sessions;  ///< in order; empty: none stated
};

/** A person left out, and why; reports must state both. */
struct LeftOut {
  std::string person;
  std::string reason;
};

struct CellMeans {
  std::vector<Factor> factors;
  std::vector<std::string> cells;    ///< "30 mm, left"; the last factor varies fastest
  std::vector<std::string> persons;  ///< persons with a value in every cell, in order of appearance
  Eigen::MatrixXd means;             ///< (num_persons x num_cells)
  std::vector<Factor> groups;        ///< factors between persons
  std::vector<std::vector<size_t>> group_levels;  ///< of each person, one per group factor
  std::vector<LeftOut> left_out;
  int num_trials = 0;   ///< trials with a value
  int num_missing = 0;  ///< trials without a value
};

/** Averages the trials of each person in each cell. Missing trials are skipped and counted; a
person with an empty cell is left out and named. No answer when nobody is left, the table is not a
complete design (an unknown level, two factors of the same name, a person in two groups, ..) or a
value is infinite. */
Answer<CellMeans> CalcCellMeans(const MeasureTable& table);

/** Returns why a value cannot be analysed: it or its square is infinite; empty: it can. */
std::string FindUnusable(double value);

/** Returns the index of a row's cell. No answer unless its levels are known. */
Answer<size_t> FindCell(const std::vector<Factor>& factors, const Observation& row);

/** Returns the level index of each of the row's groups. No answer unless all levels are known. */
Answer<std::vector<size_t>> FindGroups(const std::vector<Factor>& groups, const Observation& row);

/** Lists the labels of all combinations of levels; the last factor varies fastest. */
std::vector<std::string> ListCells(const std::vector<Factor>& factors);

}  // namespace graspbench
