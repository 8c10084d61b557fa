#include "core/base/error.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "core/base/text/escape.h"

namespace graspbench {
namespace {

size_t CalcEditDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substituted = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
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

std::string SuggestNames(std::string_view misspelt, const std::vector<std::string>& known) {
  std::string text;
  const auto closest =
      std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
        return CalcEditDistance(misspelt, a) < CalcEditDistance(misspelt, b);
      });
  if (closest != known.end() &&
      CalcEditDistance(misspelt, *closest) <= std::max<size_t>(1, misspelt.size() / 3)) {
    text += "; did you mean \"" + *closest + "\"?";
  }
  constexpr size_t kMaxListed = 24;
  text += text.empty() ? ". Known: " : " Known: ";
  for (size_t i = 0; i < known.size() && i < kMaxListed; ++i) text += (i ? ", " : "") + known[i];
  if (known.size() > kMaxListed) text += ", ...";
  if (known.empty()) text += "none";
  return text;
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
