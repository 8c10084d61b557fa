#include "core/base/error.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/base/text/text.h"

namespace graspbench {
namespace {

/** Number of letters inserted, deleted, replaced, or exchanged with their neighbour (optimal string
alignment distance, G. Navarro, ACM Comput. Surv. 33 (2001)). */
size_t CalcEditDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> before, above, row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    before = std::move(above);
    above = row;
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
  }
  return row[b.size()];
}

}  // namespace

ExitCode ExitCodeOf(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kUsage:
    case ErrorKind::kNotFound:
      return kExitUsage;
    case ErrorKind::kFormat:
    case ErrorKind::kRange:
    case ErrorKind::kVersion:
      return kExitBadInput;
    case ErrorKind::kIo:
    case ErrorKind::kEnvironment:
    case ErrorKind::kUnsupported:
      return kExitEnvironment;
    case ErrorKind::kInterrupted:
      return kExitInterrupted;
  }
  return kExitFailed;
}

namespace {

constexpr size_t kMaxListed = 24;
constexpr size_t kMaxBeside = 8;  // a longer list would hide the suggestion

}  // namespace

std::string SuggestNames(std::string_view misspelt, const std::vector<std::string>& known) {
  std::string text;
  const auto closest =
      std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
        return CalcEditDistance(misspelt, a) < CalcEditDistance(misspelt, b);
      });
  if (closest != known.end() &&
      CalcEditDistance(misspelt, *closest) <= std::max<size_t>(1, misspelt.size() / 3)) {
    text += "; did you mean \"" + *closest + "\"?";
    if (known.size() > kMaxBeside) return text;
  }
  text += text.empty() ? ". Known: " : " Known: ";
  for (size_t i = 0; i < known.size() && i < kMaxListed; ++i) text += (i ? ", " : "") + known[i];
  if (known.size() > kMaxListed) text += ", ...";
  if (known.empty()) text += "none";
  return text;
}

int Diagnostics::num_errors() const {
  return static_cast<int>(std::count_if(entries_.begin(), entries_.end(), [](const Diagnostic& d) {
    return d.severity == Severity::kError;
  }));
}

namespace {

/** Indents all lines after the first, so that no line of a nested error looks like an entry. */
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

/** Counts the lines after the first and lists the first few of them. */
std::string DescribeMore(const std::vector<int>& lines) {
  constexpr size_t kNamed = 3;
  if (lines.size() < 2) return "";
  std::string text;
  for (size_t i = 1; i < lines.size() && i <= kNamed && lines[i] > 0; ++i) {
    text += (text.empty() ? ": " : ", ") + std::to_string(lines[i]);
  }
  if (!text.empty() && lines.size() > kNamed + 1) text += " ..";
  const size_t num_more = lines.size() - 1;
  return " (and " + std::to_string(num_more) + (num_more == 1 ? " more line" : " more lines") +
         text + ")";
}

}  // namespace

std::string Diagnostics::Format() const {
  std::map<std::tuple<Severity, std::string, std::string>, std::vector<int>> lines;  // of equals
  for (const Diagnostic& d : entries_) lines[{d.severity, d.file, d.text}].push_back(d.line);
  std::string text;
  for (const Diagnostic& d : entries_) {
    std::vector<int>& equals = lines[{d.severity, d.file, d.text}];
    if (equals.empty()) continue;  // already reported with the first of them
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

namespace internal {

void DemandFailed(const char* condition, const char* file, int line, const std::string& values) {
  std::fprintf(stderr,
               "graspbench: internal error at %s:%d: %s is false (%s). Please report this.\n", file,
               line, condition, EscapeForTerminal(values).c_str());
  std::abort();
}

}  // namespace internal
}  // namespace graspbench
