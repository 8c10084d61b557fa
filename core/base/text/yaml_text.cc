#include "core/base/text/yaml_text.h"

#include <algorithm>
#include <array>

#include "core/base/text/json.h"
#include "core/base/text/text.h"

namespace graspbench {

std::string QuoteYaml(const std::string& text) { return FormatJson(Json(text)); }

std::string FormatYamlWord(const std::string& text) {
  constexpr std::array<std::string_view, 9> kTaken = {"null", "true", "false", "yes", "no",
                                                      "on",   "off",  "y",     "n"};
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_plain = [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
  };
  const bool is_word = !text.empty() && is_letter(text[0]) &&
                       std::all_of(text.begin(), text.end(), is_plain) &&
                       std::count(kTaken.begin(), kTaken.end(), ToLower(text)) == 0;
  return is_word ? text : QuoteYaml(text);
}

}  // namespace graspbench
