#include "core/base/diagnostics.h"

#include <algorithm>

#include "core/base/escape.h"

namespace graspbench {

int Diagnostics::num_errors() const {
  return static_cast<int>(std::count_if(entries_.begin(), entries_.end(), [](const Diagnostic& d) {
    return d.severity == Severity::kError;
  }));
}

std::string Diagnostics::Format() const {
  std::string text;
  for (const Diagnostic& d : entries_) {
    if (!text.empty()) text += '\n';
    text += EscapeForTerminal(d.file, LineFeeds::kEscape);  // an entry is one line
    if (d.line > 0) text += ":" + std::to_string(d.line);
    text += d.severity == Severity::kError ? ": error: " : ": warning: ";
    text += EscapeForTerminal(d.text, LineFeeds::kEscape);
  }
  return text;
}

void Diagnostics::ThrowIfErrors(ErrorKind kind, const std::string& headline) const {
  if (num_errors() > 0) throw Error(kind, headline + "\n" + Format());
}

}  // namespace graspbench
