#include "workbench/tables/text_table.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/text/text.h"

namespace graspbench {
namespace {

bool IsNumber(const std::string& cell) {
  return cell.find_first_not_of("0123456789.-+e% ") == std::string::npos || cell == "n/a";
}

/** Bytes that continue a UTF-8 character take no room. */
size_t CalcWidth(const std::string& cell) {
  return static_cast<size_t>(std::count_if(cell.begin(), cell.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

}  // namespace

TextTable::TextTable(std::vector<std::string> head) {
  for (std::string& cell : head) cell = EscapeForTerminal(cell, LineFeeds::kEscape);
  rows_.push_back(std::move(head));
}

void TextTable::AddRow(std::vector<std::string> row) {
  GRASPBENCH_DEMAND(row.size() == rows_.front().size(), std::to_string(row.size()));
  for (std::string& cell : row) cell = EscapeForTerminal(cell, LineFeeds::kEscape);
  rows_.push_back(std::move(row));
}

std::string TextTable::Format() const {
  const size_t num_columns = rows_.front().size();
  std::vector<size_t> widths(num_columns, 0);
  std::vector<bool> is_numeric(num_columns, true);
  for (const auto& row : rows_) {
    for (size_t i = 0; i < num_columns; ++i) {
      widths[i] = std::max(widths[i], CalcWidth(row[i]));
      if (&row != &rows_.front() && !IsNumber(row[i])) is_numeric[i] = false;
    }
  }
  std::string text;
  for (const auto& row : rows_) {
    std::string line;
    for (size_t i = 0; i < num_columns; ++i) {
      const std::string padding(widths[i] - CalcWidth(row[i]), ' ');
      line += (i ? "  " : "") + (is_numeric[i] ? padding + row[i] : row[i] + padding);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string FormatTable(const ShownTable& shown) {
  std::vector<std::string> heading;
  for (const ShownTable::Column& column : shown.columns) heading.push_back(column.heading);
  TextTable table(heading);
  for (size_t row = 0; row < shown.num_rows; ++row) {
    std::vector<std::string> cells;
    for (const ShownTable::Column& column : shown.columns) cells.push_back(column.cells[row]);
    table.AddRow(cells);
  }
  return table.Format();
}

}  // namespace graspbench
