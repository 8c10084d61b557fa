#include "reports/study/contrast.h"

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

/** With two digits GOT is GFT. */
bool IsRepeated(const StudyResult& result, const MeasureStatistics& statistics) {
  return result.digits.size() == 2 &&
         std::string(statistics.measure.id).rfind("grasp_opposing", 0) == 0;
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
  std::string difference;
  std::vector<std::vector<std::string>> rows;
  for (const MeasureStatistics& statistics : result.statistics.measures) {
    if (!statistics.cells || IsRepeated(result, statistics)) continue;
    const Answer<PersonContrast> contrast = CalcPersonContrast(*statistics.cells);
    if (!contrast || !contrast->test) continue;
    const ContrastTest& test = *contrast->test;
    difference = NameDifference(*contrast);
    rows.push_back({statistics.measure.name,
                    FormatWithUnit(test.difference, statistics.measure.unit),
                    FormatInterval(test, statistics.measure), FormatP(test.p),
                    FormatPersons(*contrast, test)});
  }
  if (rows.empty()) return {};
  Table table("All measures, " + difference + ". p is not adjusted over the measures.",
              {"Measure",
               "Difference",
               {"95 % interval", "of the difference, over persons"},
               {"p", "paired t test of the persons' means; Welch's test between groups"},
               "n"});
  for (const std::vector<std::string>& row : rows) {
    table.AddRow({row[0], row[1], row[2], row[3], row[4]});
  }
  return table.ToHtml();
}

std::vector<std::string> DescribeContrasts(const StudyResult& result) {
  std::vector<std::string> sentences;
  for (const MeasureStatistics& statistics : result.statistics.measures) {
    if (!statistics.cells || IsRepeated(result, statistics)) continue;
    const Answer<PersonContrast> contrast = CalcPersonContrast(*statistics.cells);
    if (contrast) sentences.push_back(DescribeContrast(*contrast, statistics.measure));
  }
  return sentences;
}

}  // namespace graspbench
