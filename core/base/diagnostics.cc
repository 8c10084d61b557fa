#include "core/base/diagnostics.h"

#include <algorithm>

#include "core/base/text/escape.h"

namespace graspbench {

int Diagnostics::num_errors() const {
  return static_cast<int>(std::count_if(entries_.begin(), entries_.end(), [](const Diagnostic& d) {
    return d.severity == Severity::kError;
  }));
}

namespace {

/** Lines behind the first, of an error within, are indented, so that none looks like an entry. */
std::string IndentLines(const std::string& text) {
  std::string indented;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    if (at > 0) at = std::min(text.find_first_not_of(" \t", at), end);
    if (!indented.empty()) indented += "\n    ";
    indented += text.substr(at, end - at);
    at = end + 1;
  }
  return indented;
}

}  // namespace

std::string Diagnostics::Format() const {
  std::string text;
  for (const Diagnostic& d : entries_) {
    if (!text.empty()) text += '\n';
    text += EscapeForTerminal(d.file, LineFeeds::kEscape);
    if (d.line > 0) text += ":" + std::to_string(d.line);
    text += d.severity == Severity::kError ? ": error: " : ": warning: ";
    text += IndentLines(EscapeForTerminal(d.text));
  }
  return text;
}

void Diagnostics::ThrowIfErrors(ErrorKind kind, const std::string& headline) const {
  if (num_errors() > 0) throw Error(kind, headline + "\n" + Format());
}

}  // namespace graspbench
