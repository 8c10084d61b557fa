#include "workbench/text/typed_words.h"

#include <fmt/core.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "workbench/terminal/command_line.h"

namespace graspbench {

std::vector<std::string> SplitWords(const std::string& line) {
  std::vector<std::string> words;
  bool is_inside = false;
  char quote = 0;
  for (const char c : line) {
    if (quote != 0) {
      if (c == quote) {
        quote = 0;
      } else {
        words.back() += c;
      }
    } else if (c == ' ' || c == '\t' || c == '\r') {
      is_inside = false;
    } else {
      if (c == '#' && !is_inside) break;
      const bool begins = !is_inside;
      if (begins) words.emplace_back();
      is_inside = true;
      if (begins && (c == '"' || c == '\'')) {
        quote = c;
      } else {
        words.back() += c;
      }
    }
  }
  if (quote != 0) {
    throw Error(ErrorKind::kUsage,
                fmt::format("a quote {} without end; close it, or leave it out", quote));
  }
  return words;
}

double ParseNumber(const std::string& word, const std::string& what, const std::string& unit,
                   double low, double high) {
  std::string digits = word;
  if (!unit.empty() && digits.size() > unit.size() &&
      digits.compare(digits.size() - unit.size(), unit.size(), unit) == 0) {
    digits.resize(digits.size() - unit.size());
  }
  double value = 0.0;
  if (ReadNumber(digits, value) && value >= low && value <= high) return value;
  throw Error(ErrorKind::kUsage,
              fmt::format("{} is \"{}\"; expected a number from {} to {}{}{}", what, word,
                          FormatSignificant(low, 6), FormatSignificant(high, 6),
                          unit.empty() ? "" : " ", unit));
}

int ParseCount(const std::string& word, const std::string& what, int low, int high) {
  int value = 0;
  if (ReadNumber(word, value) && value >= low && value <= high) return value;
  throw Error(ErrorKind::kUsage, fmt::format("{} is \"{}\"; expected a whole number from {} to {}",
                                             what, word, low, high));
}

}  // namespace graspbench
