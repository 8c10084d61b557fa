#pragma once
/** @file
Columns of trials.csv that the design is made of: which levels a factor has. */

#include <string>
#include <vector>

#include "human_study/statistics/measure_table.h"

namespace graspbench {

class DataTable;
class Diagnostics;

/** The levels of each column in the order of numbers, else of appearance. In a column of numbers
equal ones are one level, 0.03 and 0.030, as it is written first. */
std::vector<Factor> ReadFactors(const std::vector<std::string>& names, DataTable& table);

/** The level that a cell means; the cell itself when it is none. */
const std::string& FindLevel(const std::vector<std::string>& levels, const std::string& cell);

/** A warning for each two names of a column that differ in the case of letters alone. */
void WarnOfLookAlikes(const std::string& column, const DataTable& table, Diagnostics& problems);

}  // namespace graspbench
