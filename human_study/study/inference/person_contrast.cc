#include "human_study/study/inference/person_contrast.h"

#include <cmath>

#include "core/statistics/summary.h"
#include "human_study/statistics/location_tests.h"

namespace graspbench {
namespace {

/** A person's mean over the cells of one level of the first factor, which varies slowest. */
double CalcLevelMean(const CellMeans& cells, Eigen::Index person, size_t level, size_t num_levels) {
  const Eigen::Index width = cells.means.cols() / static_cast<Eigen::Index>(num_levels);
  return cells.means.row(person).segment(static_cast<Eigen::Index>(level) * width, width).mean();
}

double CalcMeanOfKnown(const std::vector<double>& values) {
  std::vector<double> known;
  for (const double value : values) {
    if (std::isfinite(value)) known.push_back(value);
  }
  return known.empty() ? std::nan("") : CalcMean(known);
}

Answer<ContrastTest> TestContrast(const PersonContrast& contrast) {
  const std::vector<double>&first = contrast.values.front(), &last = contrast.values.back();
  if (contrast.is_between) {
    const Answer<WelchTest> test = CalcWelchTest(last, first);
    if (!test) return NoAnswer{test.reason()};
    return ContrastTest{test->difference, test->interval, test->p, test->count_b, test->count_a};
  }
  const Answer<TTest> test = CalcPairedTTest(last, first);
  if (!test) return NoAnswer{test.reason()};
  return ContrastTest{test->mean, test->interval, test->p, test->count, test->count};
}

}  // namespace

Answer<PersonContrast> CalcPersonContrast(const CellMeans& cells) {
  if (cells.factors.empty() && cells.groups.empty()) return NoAnswer{"no factor and no group"};
  PersonContrast contrast;
  contrast.is_between = cells.factors.empty();
  contrast.factor = contrast.is_between ? cells.groups.front() : cells.factors.front();
  contrast.persons = cells.persons;
  const size_t num_levels = contrast.factor.levels.size();
  if (num_levels < 2) return NoAnswer{contrast.factor.name + " has one level"};
  contrast.values.assign(num_levels, std::vector<double>(cells.persons.size(), std::nan("")));
  for (size_t person = 0; person < cells.persons.size(); ++person) {
    const auto row = static_cast<Eigen::Index>(person);
    for (size_t level = 0; level < num_levels; ++level) {
      if (!contrast.is_between) {
        contrast.values[level][person] = CalcLevelMean(cells, row, level, num_levels);
      } else if (cells.group_levels[person].front() == level) {
        contrast.values[level][person] = cells.means.row(row).mean();
      }
    }
  }
  for (const std::vector<double>& values : contrast.values) {
    contrast.means.push_back(CalcMeanOfKnown(values));
  }
  contrast.test = TestContrast(contrast);
  return contrast;
}

}  // namespace graspbench
