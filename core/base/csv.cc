#include "core/base/csv.h"

namespace graspbench {

std::string FormatCsvCell(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return FormatJson(value);
  const auto& text = value.get_ref<const std::string&>();
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace graspbench
