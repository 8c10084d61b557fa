#include "workbench/terminal/terminal.h"

#include "core/base/error.h"
#include "core/base/text/text.h"

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

std::string MakePlainText(std::string text) {
  const std::string no_break = "\u00a0";
  for (size_t at = text.find(no_break); at != std::string::npos; at = text.find(no_break, at)) {
    text.replace(at, no_break.size(), " ");
  }
  return text;
}

void PrintControlled(std::FILE* stream, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stream);
  std::fflush(stream);
}

void PrintResult(std::string_view text) { PrintControlled(stdout, EscapeForTerminal(text)); }

void PrintJson(const Json& json) { PrintResult(FormatJson(json, 2) + "\n"); }

void PrintMessage(std::string_view text) {
  PrintControlled(stderr, EscapeForTerminal(text) + "\n");
}

void FlushResults() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
    throw Error(ErrorKind::kIo, "cannot write to the standard output");
  }
}

}  // namespace graspbench
