#include "workbench/terminal/diagnostics_output.h"

#include "core/base/text/text.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {

Json MakeJson(const Diagnostics& problems) {
  Json list = Json::array();
  for (const Diagnostic& d : problems.entries()) {
    list.push_back({{"severity", d.severity == Severity::kError ? "error" : "warning"},
                    {"file", d.file},
                    {"line", d.line > 0 ? Json(d.line) : Json(nullptr)},
                    {"text", d.text}});
  }
  return list;
}

void PrintFindings(const Diagnostics& problems) {
  if (!problems.entries().empty()) PrintResult(problems.Format() + "\n");
}

std::string FormatFindingCounts(const Diagnostics& problems) {
  const int num_errors = problems.num_errors();
  const int num_warnings = static_cast<int>(problems.entries().size()) - num_errors;
  std::string text;
  if (num_errors > 0) text += FormatCount(num_errors, "error");
  if (num_warnings > 0) text += (text.empty() ? "" : ", ") + FormatCount(num_warnings, "warning");
  return text.empty() ? "" : " (" + text + ")";
}

}  // namespace graspbench
