#include "human_study/statistics/measure_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace graspbench {
namespace {

/** Empty when the factors make a design. */
std::string FindFactorFault(const std::vector<Factor>& factors) {
  for (size_t i = 0; i < factors.size(); ++i) {
    const Factor& factor = factors[i];
    if (factor.levels.empty()) return "factor \"" + factor.name + "\" has no levels";
    if (!factor.numbers.empty() && factor.numbers.size() != factor.levels.size()) {
      return "factor \"" + factor.name + "\" has " + std::to_string(factor.levels.size()) +
             " levels but " + std::to_string(factor.numbers.size()) + " numbers";
    }
    for (auto level = factor.levels.begin(); level != factor.levels.end(); ++level) {
      if (std::find(factor.levels.begin(), level, *level) != level) {
        return "factor \"" + factor.name + "\" names the level \"" + *level + "\" twice";
      }
    }
    for (size_t k = 0; k < i; ++k) {
      if (factors[k].name == factor.name) return "two factors are named \"" + factor.name + "\"";
    }
  }
  return "";
}

std::string DescribeRow(const Observation& row) {
  return "person \"" + row.person + "\", trial \"" + row.trial + "\"";
}

struct Sums {
  std::vector<double> sums;
  std::vector<int> counts;
};

}  // namespace

Answer<size_t> FindCell(const std::vector<Factor>& factors, const Observation& row) {
  if (row.levels.size() != factors.size()) {
    return NoAnswer{DescribeRow(row) + " has " + std::to_string(row.levels.size()) +
                    " levels; expected one for each of " + std::to_string(factors.size()) +
                    " factors"};
  }
  size_t cell = 0;
  for (size_t i = 0; i < factors.size(); ++i) {
    const auto& levels = factors[i].levels;
    const auto found = std::find(levels.begin(), levels.end(), row.levels[i]);
    if (found == levels.end()) {
      return NoAnswer{DescribeRow(row) + ": \"" + row.levels[i] + "\" is not a level of factor \"" +
                      factors[i].name + "\""};
    }
    cell = cell * levels.size() + static_cast<size_t>(found - levels.begin());
  }
  return cell;
}

Answer<std::vector<size_t>> FindGroups(const std::vector<Factor>& groups, const Observation& row) {
  Observation own = row;
  own.levels = row.groups;
  if (own.levels.size() != groups.size()) return FindCell(groups, own).none();
  std::vector<size_t> levels;
  for (size_t i = 0; i < groups.size(); ++i) {
    own.levels = {row.groups[i]};
    const Answer<size_t> level = FindCell({groups[i]}, own);
    if (!level) return level.none();
    levels.push_back(*level);
  }
  return levels;
}

std::vector<std::string> ListCells(const std::vector<Factor>& factors) {
  std::vector<std::string> cells = {""};
  for (const Factor& factor : factors) {
    std::vector<std::string> longer;
    for (const std::string& cell : cells) {
      for (const std::string& level : factor.levels) {
        longer.push_back(cell.empty() ? level : cell + ", " + level);
      }
    }
    cells = std::move(longer);
  }
  return cells;
}

std::string FindUnusable(double value) {
  constexpr double kLargest = 1e100;  // sums of squares and of their squares stay finite
  if (std::isinf(value)) return "a value is infinite";
  if (std::abs(value) <= kLargest || std::isnan(value)) return "";
  return fmt::format("a value is {:g}; no measurement is larger than {:g}, so correct it", value,
                     kLargest);
}

Answer<CellMeans> CalcCellMeans(const MeasureTable& table) {
  std::vector<Factor> all = table.factors;
  all.insert(all.end(), table.groups.begin(), table.groups.end());
  const std::string fault = FindFactorFault(all);
  if (!fault.empty()) return NoAnswer{fault};
  CellMeans result;
  result.factors = table.factors;
  result.cells = ListCells(table.factors);
  result.groups = table.groups;
  const size_t num_cells = result.cells.size();

  std::vector<std::string> persons;
  std::map<std::string, Sums> sums;
  std::map<std::string, std::vector<size_t>> groups;
  for (const Observation& row : table.rows) {
    const Answer<size_t> cell = FindCell(table.factors, row);
    if (!cell) return cell.none();
    if (const std::string unusable = FindUnusable(row.value); !unusable.empty()) {
      return NoAnswer{DescribeRow(row) + ": " + unusable};
    }
    auto [entry, is_new] = sums.try_emplace(
        row.person, Sums{std::vector<double>(num_cells, 0.0), std::vector<int>(num_cells, 0)});
    if (is_new) persons.push_back(row.person);
    const Answer<std::vector<size_t>> own_groups = FindGroups(table.groups, row);
    if (!own_groups) return own_groups.none();
    if (groups.try_emplace(row.person, *own_groups).first->second != *own_groups) {
      return NoAnswer{DescribeRow(row) + " is in another group than the person's other trials"};
    }
    if (std::isnan(row.value)) {
      ++result.num_missing;
      continue;
    }
    ++result.num_trials;
    entry->second.sums[*cell] += row.value;
    ++entry->second.counts[*cell];
  }

  for (const std::string& person : persons) {
    const auto& counts = sums.at(person).counts;
    const auto empty = std::find(counts.begin(), counts.end(), 0);
    if (empty == counts.end()) {
      result.persons.push_back(person);
      result.group_levels.push_back(groups.at(person));
    } else {
      result.left_out.push_back(
          {person, "no value in " + result.cells[static_cast<size_t>(empty - counts.begin())]});
    }
  }
  if (result.persons.empty()) {
    return NoAnswer{"none of " + std::to_string(persons.size()) +
                    " persons has a value in every condition"};
  }
  result.means.resize(static_cast<Eigen::Index>(result.persons.size()),
                      static_cast<Eigen::Index>(num_cells));
  for (size_t p = 0; p < result.persons.size(); ++p) {
    const Sums& own = sums.at(result.persons[p]);
    for (size_t c = 0; c < num_cells; ++c) {
      result.means(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(c)) =
          own.sums[c] / own.counts[c];
    }
  }
  return result;
}

}  // namespace graspbench
