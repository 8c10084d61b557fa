#include "reports/study/contrast.h"

#include "core/base/text/text.h"
#include "human_study/study/inference/person_contrast.h"
#include "reports/page/layout.h"
#include "reports/plots/paired_plot.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

/** The difference between the last and the first level in a sentence. */
std::string DescribeContrast(const PersonContrast& contrast, const TrialMeasure& measure) {
  const std::vector<Factor> factors = {contrast.factor};
  const std::string text = std::string(measure.name) + ", " +
                           NameOfCell(contrast.factor.levels.back(), factors) + " minus " +
                           NameOfCell(contrast.factor.levels.front(), factors) + ": ";
  if (!contrast.test) return text + "not tested (" + contrast.test.reason() + ").";
  const ContrastTest& test = *contrast.test;
  const Interval interval = CutAt(FindPossibleDifference(measure), test.interval);
  return text + FormatWithUnit(test.difference, measure.unit) + ", 95\u00A0% interval " +
         FormatValue(interval.low, measure.unit) + " to " +
         FormatWithUnit(interval.high, measure.unit) + ", p\u00A0" +
         (test.p < 0.001 ? "" : "=\u00A0") + FormatP(test.p) +
         (contrast.is_between
              ? " (Welch), n\u00A0=\u00A0" + std::to_string(test.num_first) + " and "
              : std::string(" (paired t test), n\u00A0=\u00A0")) +
         FormatCount(test.num_last, "person") + ".";
}

Html DrawPersons(const PersonContrast& contrast, const TrialMeasure& measure) {
  PairedPlot plot;
  plot.text.title = std::string(measure.name) + " by " + NameOfFactor(contrast.factor.name);
  plot.text.description = "Mean of each person under each condition, and the mean over persons.";
  plot.axis = FormatHead(measure);
  const double scale = FindDisplayUnit(measure.unit).factor;
  plot.persons.resize(contrast.persons.size());
  for (size_t i = 0; i < contrast.persons.size(); ++i) plot.persons[i].name = contrast.persons[i];
  for (size_t level = 0; level < contrast.values.size(); ++level) {
    plot.conditions.push_back(NameOfCell(contrast.factor.levels[level], {contrast.factor}));
    for (size_t i = 0; i < contrast.persons.size(); ++i) {
      plot.persons[i].values.push_back(scale * contrast.values[level][i]);
    }
    plot.means.push_back(scale * contrast.means[level]);
  }
  return MakeScroll(plot.text.title, DrawPairedPlot(plot));
}

}  // namespace

Html DrawContrast(const StudyResult& result) {
  if (result.CountKept() == 0) return {};
  const std::string& main = result.study.config.multiverse.measure;
  for (const MeasureStatistics& statistics : result.statistics.measures) {
    if (statistics.measure.id != main || !statistics.cells) continue;
    const Answer<PersonContrast> contrast = CalcPersonContrast(*statistics.cells);
    if (!contrast) return {};
    return Element("p", {{"class", "verdict"}},
                   Text(DescribeContrast(*contrast, statistics.measure))) +
           MakeFigure(std::string(contrast->is_between ? "Each dot" : "Each thin line") +
                          " is one person's mean; bars and the thick line are means over persons.",
                      contrast->is_between
                          ? "whether the groups overlap, and persons far from their group."
                          : "whether most lines have the same direction, and persons that deviate.",
                      DrawPersons(*contrast, statistics.measure));
  }
  return {};
}

}  // namespace graspbench
