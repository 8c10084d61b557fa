#pragma once
/** @file
Table for the terminal: columns are as wide as their widest cell and separated by two spaces.
Columns of numbers are aligned to the right. Cells are escaped for the terminal: a name from a file
can neither break its line nor shift its column. */

#include <string>
#include <vector>

#include "core/base/text/csv.h"

namespace graspbench {

class TextTable {
 public:
  explicit TextTable(std::vector<std::string> head);
  /** @pre as many cells as the head has. */
  void AddRow(std::vector<std::string> row);
  /** Formats the table. Every row ends with a line feed and has no trailing spaces. */
  std::string Format() const;

 private:
  std::vector<std::vector<std::string>> rows_;  // the head first
};

/** Formats the rows of an analysis. */
std::string FormatTable(const ShownTable& shown);

}  // namespace graspbench
