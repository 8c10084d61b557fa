#pragma once
/** @file
Lines and cells of tab- or comma-separated text, with line numbers for messages, and small tables
that are written by a person. */

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
  /** @param line  number of lines before the start of the stream. */
  LineReader(std::istream& stream, std::string file, int line = 0)
      : stream_(stream), file_(std::move(file)), line_(line) {}

  /** Reads the next line, valid until the next call; returns false at the end. */
  bool Next(std::string_view& line);
  /** Reads the next line; an end of the file is an error: "the file ends before <what>". */
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

/** Splits at `delimiter` and trims blanks and enclosing double quotes. A quoted cell may contain
the delimiter, and quotes as pairs (RFC 4180), which stay pairs here. An empty line has one empty
cell. */
void SplitCells(std::string_view line, char delimiter, Cells& cells);
/** Returns NaN for an empty cell, "nan", "na" or "n/a"; anything else that is not a number fails
with line and column. */
double ParseNumber(const Cells& cells, size_t column, const LineReader& reader);

/** Returns nullopt unless the whole text is a finite number. */
std::optional<double> ParseFiniteNumber(std::string_view text);

/** Parses a number of a header; fails, naming `what`, unless it is in [min, max]. */
double ParseHeaderNumber(std::string_view cell, const std::string& what, double min, double max,
                         const LineReader& reader);

/** Removes empty cells at the end, because exporters often write one delimiter too many. */
void DropEmptyEnd(Cells& cells);

bool IsBlank(const Cells& cells);

bool StartsWith(std::string_view text, std::string_view start);

/** A table written by a person: a heading and one item per row, separated by commas, tabs or
semicolons. Every fault goes into Diagnostics with file and line. */
class DataTable {
 public:
  /** Rows whose number of cells differs from the heading's, duplicate column names and a table
  without rows are reported. `file` is the name in messages. */
  DataTable(const std::string& text, const std::string& file, Diagnostics& problems);

  size_t num_rows() const { return rows_.size(); }
  int LineOfRow(size_t row) const { return rows_[row].line; }
  const std::string& file() const { return file_; }
  const std::vector<std::string>& columns() const { return columns_; }
  bool Has(const std::string& column) const;

  /** Reports a problem at the heading if the column is missing. */
  void Require(const std::string& column);
  /** Returns the cell's text; empty if the column is missing or the cell is empty. */
  const std::string& Text(size_t row, const std::string& column) const;
  /** Returns the cell's number; NaN for an empty cell. Text that is not a finite number is
  reported. */
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
