#include "core/base/diagnostics.h"

#include <algorithm>
#include <map>
#include <tuple>

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

/** The lines behind the first, the last of many. */
std::string DescribeMore(const std::vector<int>& lines) {
  constexpr size_t kNamed = 3;
  if (lines.size() < 2) return "";
  std::string text;
  for (size_t i = 1; i < lines.size() && i <= kNamed && lines[i] > 0; ++i) {
    text += (text.empty() ? ": " : ", ") + std::to_string(lines[i]);
  }
  if (!text.empty() && lines.size() > kNamed + 1) text += " ..";
  const size_t num_more = lines.size() - 1;
  return " (and " + std::to_string(num_more) + (num_more == 1 ? " line more" : " lines more") +
         text + ")";
}

}  // namespace

std::string Diagnostics::Format() const {
  std::map<std::tuple<Severity, std::string, std::string>, std::vector<int>> lines;  // of equals
  for (const Diagnostic& d : entries_) lines[{d.severity, d.file, d.text}].push_back(d.line);
  std::string text;
  for (const Diagnostic& d : entries_) {
    std::vector<int>& equals = lines[{d.severity, d.file, d.text}];
    if (equals.empty()) continue;  // said at the first of them
    if (!text.empty()) text += '\n';
    text += EscapeForTerminal(d.file, LineFeeds::kEscape);
    if (d.line > 0) text += ":" + std::to_string(d.line);
    text += d.severity == Severity::kError ? ": error: " : ": warning: ";
    text += IndentLines(EscapeForTerminal(d.text)) + DescribeMore(equals);
    equals.clear();
  }
  return text;
}

void Diagnostics::ThrowIfErrors(ErrorKind kind, const std::string& headline) const {
  if (num_errors() > 0) throw Error(kind, headline + "\n" + Format());
}

}  // namespace graspbench
