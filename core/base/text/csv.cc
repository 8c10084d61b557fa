#include "core/base/text/csv.h"

#include <algorithm>
#include <charconv>

namespace graspbench {
namespace {

/** Whether a spreadsheet would run what stands behind the apostrophes. */
bool IsFormula(std::string_view text) {
  if (text.empty()) return false;
  const auto first = static_cast<unsigned char>(text.front());
  return text.find_first_of("=+-@") == 0 || first < 0x20 || first == 0x7f;
}

std::string_view SkipApostrophes(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of('\''), text.size()));
  return text;
}

bool IsNumber(std::string_view text) {
  if (text[0] == '+' && text.substr(1, 1) != "-") text.remove_prefix(1);
  double value = 0.0;
  const auto [rest, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc() && rest == text.data() + text.size();
}

}  // namespace

std::string GuardCell(const std::string& text) {
  if (!IsFormula(SkipApostrophes(text)) || IsNumber(text)) return text;
  return "'" + text;
}

std::string UnguardCell(const std::string& cell) {
  return !cell.empty() && cell[0] == '\'' && IsFormula(SkipApostrophes(cell)) ? cell.substr(1)
                                                                              : cell;
}

std::string FormatCsvCell(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return FormatJson(value);
  const std::string text = GuardCell(value.str());
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string FormatCsvLine(const std::vector<Json>& cells) {
  std::string line;
  for (size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? "," : "") + FormatCsvCell(cells[i]);
  return line + "\n";
}

}  // namespace graspbench
