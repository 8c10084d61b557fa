#include "core/base/text/data_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/base/text/csv.h"
#include "core/base/text/delimited_text.h"
#include "core/base/text/utf16.h"

namespace graspbench {
namespace {

const std::string kEmpty;

/** Spreadsheets of countries with a decimal comma separate by semicolons. */
char FindDelimiter(std::string_view heading) {
  for (const char delimiter : {'\t', ',', ';'}) {
    if (heading.find(delimiter) != std::string_view::npos) return delimiter;
  }
  return ',';
}

}  // namespace

DataTable::DataTable(const std::string& text, const std::string& file, Diagnostics& problems)
    : file_(file), problems_(&problems) {
  if (IsUtf16(text)) {
    problems.Fail(
        file, 0,
        "is UTF-16 (\"Unicode text\" of a spreadsheet); save it as UTF-8, for instance as "
        "\"CSV UTF-8\"");
    return;
  }
  std::istringstream stream(text);
  LineReader reader(stream, file);
  std::string_view line;
  char delimiter = ',';
  while (reader.Next(line)) {
    if (columns_.empty()) delimiter = FindDelimiter(line);
    const std::vector<std::string> cells = SplitTexts(line, delimiter);
    if (std::all_of(cells.begin(), cells.end(), [](const auto& c) { return c.empty(); })) continue;
    if (columns_.empty()) {
      columns_ = cells;
      for (auto name = columns_.begin(); name != columns_.end(); ++name) {
        if (std::find(columns_.begin(), name, *name) != name) {
          problems.Fail(file, reader.line(), "the column \"" + *name + "\" is there twice");
        }
      }
      continue;
    }
    if (cells.size() != columns_.size()) {
      problems.Fail(file, reader.line(),
                    std::to_string(cells.size()) + " cells; expected " +
                        std::to_string(columns_.size()) + ", as many as the heading has");
      continue;
    }
    rows_.push_back({reader.line(), {}});
    for (const std::string& cell : cells) rows_.back().cells.push_back(UnguardCell(cell));
  }
  if (rows_.empty()) {
    problems.Fail(file, 0, "holds no rows; expected a heading and one row each");
  }
}

bool DataTable::Has(const std::string& column) const {
  return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
}

void DataTable::Require(const std::string& column) {
  if (Has(column)) return;
  problems_->Fail(file_, 1,
                  "the column \"" + column + "\" is missing" + SuggestNames(column, columns_));
}

const std::string& DataTable::Text(size_t row, const std::string& column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) return kEmpty;
  return rows_[row].cells[static_cast<size_t>(found - columns_.begin())];
}

double DataTable::Number(size_t row, const std::string& column) {
  const std::string& text = Text(row, column);
  if (text.empty()) return std::nan("");
  const std::optional<double> number = ParseFiniteNumber(text);
  if (!number) {
    problems_->Fail(file_, LineOfRow(row),
                    column + ": \"" + text + "\" is not a number; expected one, or an empty cell");
  }
  return number.value_or(std::nan(""));
}

}  // namespace graspbench
