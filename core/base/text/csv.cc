#include "core/base/text/csv.h"

#include <algorithm>
#include <charconv>

namespace graspbench {
namespace {

/** Characters that may start a new cell in a spreadsheet of some locale, even within quotes: it
honours quotes only at the start of its own cells. */
constexpr std::string_view kSeparators = ";\t\r\n";

/** Whether a spreadsheet would evaluate what follows the leading apostrophes and quotes. */
bool IsFormula(std::string_view part) {
  part.remove_prefix(std::min(part.find_first_not_of("'\""), part.size()));
  if (part.empty()) return false;
  const auto first = static_cast<unsigned char>(part.front());
  if (part.find_first_of("=+-@") == 0 || first < 0x20 || first == 0x7f) return true;
  for (const char* wide : {"\uff1d", "\uff0b", "\uff0d", "\uff20"}) {  // full-width = + - @
    if (part.rfind(wide, 0) == 0) return true;
  }
  return false;
}

bool IsNumber(std::string_view text) {
  if (text[0] == '+' && text.substr(1, 1) != "-") text.remove_prefix(1);
  double value = 0.0;
  const auto [rest, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc() && rest == text.data() + text.size();
}

}  // namespace

std::string GuardCell(const std::string& text) {
  std::string guarded;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find_first_of(kSeparators, begin), text.size());
    const std::string_view part = std::string_view(text).substr(begin, end + 1 - begin);
    const bool is_number = begin == 0 && !text.empty() && IsNumber(text);
    if (IsFormula(part) && !is_number) guarded += '\'';
    guarded += part;
    begin = end + 1;
  }
  return guarded;
}

std::string UnguardCell(const std::string& cell) {
  std::string text;
  for (size_t begin = 0; begin <= cell.size();) {
    const size_t end = std::min(cell.find_first_of(kSeparators, begin), cell.size());
    std::string_view part = std::string_view(cell).substr(begin, end + 1 - begin);
    if (!part.empty() && part[0] == '\'' && IsFormula(part)) part.remove_prefix(1);
    text += part;
    begin = end + 1;
  }
  return text;
}

std::string FormatCsvCell(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return FormatJson(value);
  const std::string text = GuardCell(value.str());
  if (text.find_first_of(",;\t\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string FormatShownCell(const Json& value) {
  return value.is_string() ? value.str() : FormatCsvCell(value);
}

std::string FormatCsvLine(const std::vector<Json>& cells) {
  std::string line;
  for (size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? "," : "") + FormatCsvCell(cells[i]);
  return line + "\n";
}

}  // namespace graspbench
