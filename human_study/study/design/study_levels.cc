#include "human_study/study/design/study_levels.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text/data_table.h"
#include "core/base/text/delimited_text.h"
#include "core/base/text/text.h"

namespace graspbench {
namespace {

double NumberOf(const std::string& level) {
  return ParseFiniteNumber(level).value_or(std::nan(""));
}

}  // namespace

std::vector<Factor> ReadFactors(const std::vector<std::string>& names, DataTable& table) {
  std::vector<Factor> factors;
  for (const std::string& name : names) {
    Factor factor;
    factor.name = name;
    table.Require(name);
    std::vector<std::string>& levels = factor.levels;
    for (size_t row = 0; row < table.num_rows(); ++row) {
      const std::string& level = table.Text(row, name);
      if (std::find(levels.begin(), levels.end(), level) == levels.end()) levels.push_back(level);
    }
    const bool is_number = std::all_of(levels.begin(), levels.end(),
                                       [](const auto& l) { return !std::isnan(NumberOf(l)); });
    if (is_number) {
      std::stable_sort(levels.begin(), levels.end(),
                       [](const auto& a, const auto& b) { return NumberOf(a) < NumberOf(b); });
      const auto is_equal = [](const auto& a, const auto& b) { return NumberOf(a) == NumberOf(b); };
      levels.erase(std::unique(levels.begin(), levels.end(), is_equal), levels.end());
      for (const std::string& level : levels) factor.numbers.push_back(NumberOf(level));
    }
    factors.push_back(factor);
  }
  return factors;
}

const std::string& FindLevel(const std::vector<std::string>& levels, const std::string& cell) {
  const auto same = std::find(levels.begin(), levels.end(), cell);
  if (same != levels.end()) return *same;
  const double number = NumberOf(cell);
  const auto equal = std::find_if(levels.begin(), levels.end(),
                                  [&](const auto& level) { return NumberOf(level) == number; });
  return equal == levels.end() ? cell : *equal;
}

void WarnOfLookAlikes(const std::string& column, const DataTable& table, Diagnostics& problems) {
  std::map<std::string, std::vector<std::string>> spellings;
  for (size_t row = 0; row < table.num_rows(); ++row) {
    const std::string& name = table.Text(row, column);
    std::vector<std::string>& known = spellings[ToLower(name)];
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    known.push_back(name);
    if (known.size() < 2) continue;
    problems.Warn(table.file(), table.LineOfRow(row),
                  column + ": \"" + name + "\" and \"" + known.front() +
                      "\" count as two; if they are one, spell them alike");
  }
}

}  // namespace graspbench
