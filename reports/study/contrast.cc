#include "reports/study/contrast.h"

#include <utility>

#include "core/base/text/text.h"
#include "human_study/study/inference/person_contrast.h"
#include "reports/page/layout.h"
#include "reports/plots/paired_plot.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

/** "size small minus size large". */
std::string NameDifference(const PersonContrast& contrast) {
  const std::vector<Factor> factors = {contrast.factor};
  return NameOfCell(contrast.factor.levels.back(), factors) + " minus " +
         NameOfCell(contrast.factor.levels.front(), factors);
}

std::string FormatInterval(const ContrastTest& test, const TrialMeasure& measure) {
  const Interval interval = CutAt(FindPossibleDifference(measure), test.interval);
  return FormatValue(interval.low, measure.unit) + " to " +
         FormatWithUnit(interval.high, measure.unit);
}

std::string FormatPersons(const PersonContrast& contrast, const ContrastTest& test) {
  return (contrast.is_between ? std::to_string(test.num_first) + " and " : std::string()) +
         FormatCount(test.num_last, "person");
}

std::string DescribeContrast(const PersonContrast& contrast, const TrialMeasure& measure) {
  const std::string text = std::string(measure.name) + ", " + NameDifference(contrast) + ": ";
  if (!contrast.test) return text + "not tested (" + contrast.test.reason() + ").";
  const ContrastTest& test = *contrast.test;
  return text + FormatWithUnit(test.difference, measure.unit) + ", 95 % interval " +
         FormatInterval(test, measure) + ", p " + (test.p < 0.001 ? "" : "= ") + FormatP(test.p) +
         (contrast.is_between ? " (Welch), n = " : " (paired t test), n = ") +
         FormatPersons(contrast, test) + ".";
}

struct MeasureContrast {
  const TrialMeasure* measure;
  PersonContrast contrast;
};

/** Of the tested measures. With two digits GOT is GFT and is left out. */
std::vector<MeasureContrast> ListContrasts(const StudyResult& result) {
  std::vector<MeasureContrast> contrasts;
  for (const MeasureStatistics& statistics : result.statistics.measures) {
    const bool is_repeated = result.digits.size() == 2 &&
                             std::string(statistics.measure.id).rfind("grasp_opposing", 0) == 0;
    if (!statistics.cells || is_repeated) continue;
    Answer<PersonContrast> contrast = CalcPersonContrast(*statistics.cells);
    if (contrast) contrasts.push_back({&statistics.measure, std::move(*contrast)});
  }
  return contrasts;
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

Html DrawContrastTable(const StudyResult& result) {
  std::vector<MeasureContrast> tested;
  for (MeasureContrast& one : ListContrasts(result)) {
    if (one.contrast.test) tested.push_back(std::move(one));
  }
  if (tested.empty()) return {};
  Table table("All measures, " + NameDifference(tested.front().contrast) +
                  ". p is not adjusted over the measures.",
              {"Measure",
               "Difference",
               {"95 % interval", "of the difference, over persons"},
               {"p", "paired t test of the persons' means; Welch's test between groups"},
               "n"});
  for (const auto& [measure, contrast] : tested) {
    const ContrastTest& test = *contrast.test;
    table.AddRow({measure->name, FormatWithUnit(test.difference, measure->unit),
                  FormatInterval(test, *measure), FormatP(test.p), FormatPersons(contrast, test)});
  }
  return table.ToHtml();
}

std::vector<std::string> DescribeContrasts(const StudyResult& result) {
  std::vector<std::string> sentences;
  for (const auto& [measure, contrast] : ListContrasts(result)) {
    sentences.push_back(DescribeContrast(contrast, *measure));
  }
  return sentences;
}

}  // namespace graspbench
