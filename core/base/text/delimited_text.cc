#include "core/base/text/delimited_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "core/base/error.h"
#include "core/base/text/csv.h"
#include "core/base/text/text.h"

namespace graspbench {
namespace {

std::string_view Trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

/** Returns the cell as messages print it: short, quoted and without control characters. */
std::string Quote(std::string_view cell) {
  std::string shown;
  for (const char c : cell.substr(0, 40)) {
    shown += static_cast<unsigned char>(c) < 32 || c == 127 ? '?' : c;
  }
  shown = EscapeForTerminal(shown);  // the file may be broken, or a character cut in two
  return "\"" + shown + (cell.size() > 40 ? "...\"" : "\"");
}

bool ParsePlain(std::string_view cell, double& value) {
  if (!cell.empty() && cell.front() == '+') cell.remove_prefix(1);
  const auto [end, fault] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return fault == std::errc() && end == cell.data() + cell.size();
}

/** Whether the cell would be a number but for its decimal comma: "-350,09". */
bool HasDecimalComma(std::string_view cell) {
  std::string text(cell.substr(0, 40));
  const size_t comma = text.find(',');
  if (comma == std::string::npos) return false;
  text[comma] = '.';
  double value = 0.0;
  return ParsePlain(text, value);
}

struct QuotedCell {
  std::string_view text;  // without its quotes
  bool is_quoted = false;
};

/** Position of the quote that closes the one at `start`: the first that is not doubled. */
size_t FindClosingQuote(std::string_view line, size_t start) {
  size_t quote = line.find('"', start + 1);
  while (quote != std::string_view::npos && line.substr(quote + 1, 1) == "\"") {
    quote = line.find('"', quote + 2);
  }
  return quote;
}

/** Removes the first cell from the line and returns it. */
QuotedCell TakeCell(std::string_view& line, char delimiter, bool& is_last) {
  const size_t start = line.find_first_not_of(' ');
  size_t end = std::string_view::npos;
  if (start != std::string_view::npos && line[start] == '"') {
    const size_t quote = FindClosingQuote(line, start);
    end = line.find(delimiter, quote == std::string_view::npos ? start : quote);
  } else {
    end = line.find(delimiter);
  }
  QuotedCell cell = {Trim(line.substr(0, end))};
  if (cell.text.size() >= 2 && cell.text.front() == '"' && cell.text.back() == '"') {
    cell = {cell.text.substr(1, cell.text.size() - 2), true};
  }
  is_last = end == std::string_view::npos;
  if (!is_last) line.remove_prefix(end + 1);
  return cell;
}

/** Spreadsheets use semicolons in countries with a decimal comma. */
char FindDelimiter(std::string_view heading) {
  for (const char delimiter : {'\t', ',', ';'}) {
    if (heading.find(delimiter) != std::string_view::npos) return delimiter;
  }
  return ',';
}

/** Like SplitCells, but returns copies in which a doubled quote of a quoted cell is one quote. */
std::vector<std::string> SplitTexts(std::string_view line, char delimiter) {
  std::vector<std::string> texts;
  for (bool is_last = false; !is_last;) {
    const QuotedCell cell = TakeCell(line, delimiter, is_last);
    std::string& text = texts.emplace_back(cell.text);
    for (size_t at = 0; cell.is_quoted && (at = text.find("\"\"", at)) != std::string::npos;) {
      text.erase(at++, 1);
    }
  }
  return texts;
}

}  // namespace

bool LineReader::Next(std::string_view& line) {
  if (!std::getline(stream_, buffer_)) return false;
  ++line_;
  line = buffer_;
  if (line_ == 1 && StartsWith(line, "\xef\xbb\xbf")) line.remove_prefix(3);
  while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

std::string_view LineReader::Require(const std::string& what) {
  std::string_view line;
  if (!Next(line)) {
    ++line_;
    Fail("the file ends before " + what);
  }
  return line;
}

void LineReader::Fail(const std::string& text) const {
  throw Error(ErrorKind::kFormat, file_ + ":" + std::to_string(line_) + ": " + text);
}

void SplitCells(std::string_view line, char delimiter, Cells& cells) {
  cells.clear();
  for (bool is_last = false; !is_last;) {
    cells.push_back(TakeCell(line, delimiter, is_last).text);
  }
}

double ParseNumber(const Cells& cells, size_t column, const LineReader& reader) {
  const std::string_view cell = cells[column];
  double value = std::nan("");
  if (cell.empty() || ParsePlain(cell, value)) return value;
  const std::string lower = ToLower(cell);
  if (lower == "n/a" || lower == "na") return std::nan("");
  reader.Fail("column " + std::to_string(column + 1) + ": " + Quote(cell) + " is not a number" +
              (HasDecimalComma(cell) ? ": it has a decimal comma; export with points" : ""));
}

std::optional<double> ParseFiniteNumber(std::string_view text) {
  double value = 0.0;
  if (!ParsePlain(text, value) || !std::isfinite(value)) return std::nullopt;
  return value;
}

double ParseHeaderNumber(std::string_view cell, const std::string& what, double min, double max,
                         const LineReader& reader) {
  double value = 0.0;
  if (!ParsePlain(cell, value) || !(value >= min && value <= max)) {
    reader.Fail(what + " is " + Quote(cell) + "; expected a number " +
                fmt::format("from {:.15g} to {:.15g}", min, max));
  }
  return value;
}

void DropEmptyEnd(Cells& cells) {
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
}

bool IsBlank(const Cells& cells) {
  return std::all_of(cells.begin(), cells.end(), [](std::string_view c) { return c.empty(); });
}

bool StartsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

DataTable::DataTable(const std::string& text, const std::string& file, Diagnostics& problems)
    : file_(file), problems_(&problems) {
  if (IsUtf16(text)) {
    problems.Fail(
        file, 0,
        "is UTF-16 (\"Unicode text\" of a spreadsheet); save it as UTF-8, for instance as "
        "\"CSV UTF-8\"");
    return;
  }
  std::string lines = text;
  // "CSV (Macintosh)" files of spreadsheets end lines with a carriage return alone.
  if (text.find('\n') == text.npos) std::replace(lines.begin(), lines.end(), '\r', '\n');
  std::istringstream stream(lines);
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
  static const std::string empty;
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) return empty;
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
