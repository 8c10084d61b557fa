#include "core/base/error.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "core/base/text/escape.h"

namespace graspbench {
namespace {

/** Letters inserted, left out, replaced, or exchanged with their neighbour (optimal string
alignment, G. Navarro, ACM Comput. Surv. 33 (2001)). */
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
constexpr size_t kMaxBeside = 8;  // names beside a suggestion; more hide it

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

namespace internal {

void DemandFailed(const char* condition, const char* file, int line, const std::string& values) {
  std::fprintf(stderr,
               "graspbench: internal error at %s:%d: %s is false (%s). Please report this.\n", file,
               line, condition, EscapeForTerminal(values).c_str());
  std::abort();
}

}  // namespace internal
}  // namespace graspbench
