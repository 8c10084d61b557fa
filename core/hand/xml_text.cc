#include "core/hand/xml_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>

#include "core/base/text/text.h"

namespace graspbench {

std::optional<std::vector<double>> ParseNumbers(const char* text) {
  const char* const end = text + std::strlen(text);
  const auto is_blank = [](char c) {
    return std::isspace(static_cast<unsigned char>(c)) || c == ',';
  };
  std::vector<double> numbers;
  for (const char* at = text;;) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return numbers;
    if (*at == '+') ++at;
    double number = 0.0;
    const auto [next, status] = std::from_chars(at, end, number);
    if (status != std::errc() || !std::isfinite(number) || std::abs(number) >= 1e9) return {};
    if (next != end && !is_blank(*next)) return {};
    numbers.push_back(number);
    at = next;
  }
}

std::string JoinSome(const std::vector<std::string>& names) {
  constexpr size_t kMost = 3;
  std::string text;
  for (size_t i = 0; i < std::min(kMost, names.size()); ++i) {
    text += (i > 0 ? ", \"" : "\"") + names[i] + "\"";
  }
  if (names.size() > kMost) text += " and " + std::to_string(names.size() - kMost) + " more";
  return text;
}

std::string NameList::Add(const char* text, std::vector<std::string>& changes) {
  std::string name = text ? text : "";
  for (char& c : name) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  if (name.empty() || !IsUtf8(name)) {
    name = kind_ + "_" + std::to_string(taken_.size() + 1);
    changes.push_back(kind_ + " without a name that is text; called \"" + name + "\"");
  }
  if (taken_.insert(name).second) return name;
  std::string other;
  for (int number = 2; !taken_.insert(other = name + "_" + std::to_string(number)).second;) {
    ++number;
  }
  changes.push_back(kind_ + " \"" + name + "\": the name is taken; called \"" + other + "\"");
  return other;
}

}  // namespace graspbench
