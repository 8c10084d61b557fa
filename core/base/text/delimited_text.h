#pragma once
/** @file
Lines and cells of tab- or comma-separated text, with line numbers for messages; the small tables
that a person writes. */

#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace graspbench {

/** Reads lines; strips a byte order mark and carriage returns. */
class LineReader {
 public:
  /** @param line  so many lines stand before what is read. */
  LineReader(std::istream& stream, std::string file, int line = 0)
      : stream_(stream), file_(std::move(file)), line_(line) {}

  /** The next line, valid until the next call; false at the end. */
  bool Next(std::string_view& line);
  /** As Next, but an end of the file is an error: "ends before <what>". */
  std::string_view Require(const std::string& what);
  int line() const { return line_; }
  const std::string& file() const { return file_; }
  [[noreturn]] void Fail(const std::string& text) const;

 private:
  std::istream& stream_;
  std::string file_;
  std::string buffer_;
  int line_;
};

using Cells = std::vector<std::string_view>;

/** Splits at `delimiter` and trims blanks and enclosing double quotes; a quoted cell may hold the
delimiter, and quotes as two (RFC 4180), which stay two here. Empty line: one empty cell. */
void SplitCells(std::string_view line, char delimiter, Cells& cells);
/** NaN for an empty cell, "nan" or "n/a"; anything else that is not a number fails with line and
column. */
double ParseNumber(const Cells& cells, size_t column, const LineReader& reader);

/** Nothing unless the whole text is a finite number. */
std::optional<double> ParseFiniteNumber(std::string_view text);

/** A number of a header: finite and within [min, max], else fails naming `what`. */
double ParseHeaderNumber(std::string_view cell, const std::string& what, double min, double max,
                         const LineReader& reader);

/** Drops empty cells at the end: exporters like to write a delimiter too many. */
void DropEmptyEnd(Cells& cells);

bool IsBlank(const Cells& cells);

bool StartsWith(std::string_view text, std::string_view start);

/** A table that a person writes: separated by commas, tabs or semicolons, a heading, one
thing a row. Every fault goes into Diagnostics with file and line. */
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
