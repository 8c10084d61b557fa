#pragma once
/** @file
The small tables that a person writes: separated by commas, tabs or semicolons, a heading, one
thing a row. Every fault goes into Diagnostics with file and line. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"

namespace graspbench {

class DataTable {
 public:
  /** Rows with another number of cells than the heading, names given twice and a table without rows
  are problems. `file` is its name in messages. */
  DataTable(const std::string& text, const std::string& file, Diagnostics& problems);

  size_t num_rows() const { return rows_.size(); }
  int LineOfRow(size_t row) const { return rows_[row].line; }
  const std::string& file() const { return file_; }
  const std::vector<std::string>& columns() const { return columns_; }
  bool Has(const std::string& column) const;

  /** A problem at the heading when the table lacks the column. */
  void Require(const std::string& column);
  /** Empty when the table lacks the column or the cell is empty. */
  const std::string& Text(size_t row, const std::string& column) const;
  /** NaN for an empty cell; text that is no finite number is a problem. */
  double Number(size_t row, const std::string& column);

 private:
  struct Row {
    int line = 0;
    std::vector<std::string> cells;
  };
  std::string file_;
  Diagnostics* problems_;
  std::vector<std::string> columns_;
  std::vector<Row> rows_;
};

}  // namespace graspbench
