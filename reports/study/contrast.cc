#include "reports/study/contrast.h"

#include <cmath>

#include "core/base/text/text.h"
#include "core/statistics/summary.h"
#include "human_study/statistics/location_tests.h"
#include "reports/page/layout.h"
#include "reports/plots/paired_plot.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

/** Means of persons at the levels of one factor. */
struct Contrast {
  Factor factor;
  bool is_between = false;  ///< a person has one level
  std::vector<std::string> persons;
  std::vector<std::vector<double>> values;  ///< [level][person], SI; NaN: none
};

/** A person's mean over the cells of one level of the first factor, which varies slowest. */
double CalcLevelMean(const CellMeans& cells, Eigen::Index person, size_t level, size_t num_levels) {
  const Eigen::Index width = cells.means.cols() / static_cast<Eigen::Index>(num_levels);
  return cells.means.row(person).segment(static_cast<Eigen::Index>(level) * width, width).mean();
}

Contrast MakeContrast(const CellMeans& cells) {
  Contrast contrast;
  contrast.is_between = cells.factors.empty();
  contrast.factor = contrast.is_between ? cells.groups.front() : cells.factors.front();
  contrast.persons = cells.persons;
  const size_t num_levels = contrast.factor.levels.size();
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
  return contrast;
}

std::string FormatTest(double difference, const Interval& interval, double p, const char* unit) {
  return FormatWithUnit(difference, unit) + ", 95\u00A0% interval " +
         FormatValue(interval.low, unit) + " to " + FormatWithUnit(interval.high, unit) +
         ", p\u00A0" + (p < 0.001 ? "" : "=\u00A0") + FormatP(p);
}

/** The difference between the last and the first level in a sentence. */
std::string DescribeContrast(const Contrast& contrast, const TrialMeasure& measure) {
  const std::vector<Factor> factors = {contrast.factor};
  const std::string first = NameOfCell(contrast.factor.levels.front(), factors),
                    last = NameOfCell(contrast.factor.levels.back(), factors);
  std::string text = std::string(measure.name) + ", " + last + " minus " + first + ": ";
  if (contrast.is_between) {
    const Answer<WelchTest> test = CalcWelchTest(contrast.values.back(), contrast.values.front());
    if (!test) return text + "not tested (" + test.reason() + ").";
    return text + FormatTest(test->difference, test->interval, test->p, measure.unit) +
           " (Welch), n\u00A0=\u00A0" + std::to_string(test->count_b) + " and " +
           FormatCount(test->count_a, "person") + ".";
  }
  const Answer<TTest> test = CalcPairedTTest(contrast.values.back(), contrast.values.front());
  if (!test) return text + "not tested (" + test.reason() + ").";
  return text + FormatTest(test->mean, test->interval, test->p, measure.unit) +
         " (paired t test), n\u00A0=\u00A0" + FormatCount(test->count, "person") + ".";
}

Html DrawPersons(const Contrast& contrast, const TrialMeasure& measure) {
  PairedPlot plot;
  plot.text.title = std::string(measure.name) + " by " + NameOfFactor(contrast.factor.name);
  plot.text.description = "Mean of each person under each condition, and the mean over persons.";
  plot.axis = FormatHead(measure);
  const double scale = FindDisplayUnit(measure.unit).factor;
  plot.persons.resize(contrast.persons.size());
  for (size_t i = 0; i < contrast.persons.size(); ++i) plot.persons[i].name = contrast.persons[i];
  for (size_t level = 0; level < contrast.values.size(); ++level) {
    plot.conditions.push_back(NameOfCell(contrast.factor.levels[level], {contrast.factor}));
    std::vector<double> known;
    for (size_t i = 0; i < contrast.persons.size(); ++i) {
      const double value = scale * contrast.values[level][i];
      plot.persons[i].values.push_back(value);
      if (std::isfinite(value)) known.push_back(value);
    }
    plot.means.push_back(known.empty() ? std::nan("") : CalcMean(known));
  }
  return MakeScroll(plot.text.title, DrawPairedPlot(plot));
}

}  // namespace

Html DrawContrast(const StudyResult& result) {
  if (result.CountKept() == 0) return {};
  const std::string& main = result.study.config.multiverse.measure;
  for (const MeasureStatistics& statistics : result.statistics.measures) {
    if (statistics.measure.id != main || !statistics.cells) continue;
    const CellMeans& cells = *statistics.cells;
    if (cells.factors.empty() && cells.groups.empty()) return {};
    const Contrast contrast = MakeContrast(cells);
    if (contrast.factor.levels.size() < 2) return {};
    return Element("p", {{"class", "verdict"}},
                   Text(DescribeContrast(contrast, statistics.measure))) +
           MakeFigure(std::string(contrast.is_between ? "Each dot" : "Each thin line") +
                          " is one person's mean; bars and the thick line are means over persons.",
                      contrast.is_between
                          ? "whether the groups overlap, and persons far from their group."
                          : "whether most lines go the same way, and persons that go another.",
                      DrawPersons(contrast, statistics.measure));
  }
  return {};
}

}  // namespace graspbench
