#include "core/base/text/text.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

/** Describes the study's own value, or why it has none. */
std::string DescribeOwn(const ComparedValue& value) {
  if (!value.published->is_slope) {
    if (!value.summary) return "no value (" + value.summary.reason() + ")";
    const Summary& summary = *value.summary;
    const char* unit = value.measure->unit;
    return "median " + FormatWithUnit(summary.median, unit) + ", quartiles " +
           FormatValue(summary.lower_quartile, unit) + " to " +
           FormatWithUnit(summary.upper_quartile, unit) + ", " +
           FormatCount(summary.count, "trial");
  }
  const Answer<TTest>& test = value.slopes.test;
  const std::string unit =
      FormatSlopeUnit(std::string(value.measure->unit) + " per " + value.factor);
  if (!test) {
    if (value.slopes.persons.size() == 1 && value.slopes.persons.front().line) {
      return FormatSignificant(value.slopes.persons.front().line->slope, 3) + " " + unit +
             ", one person";
    }
    return "no slope (" + test.reason() + ")";
  }
  return FormatSignificant(test->mean, 3) + " " + unit + " (95 % " +
         FormatSignificant(test->interval.low, 3) + " to " +
         FormatSignificant(test->interval.high, 3) + "), " + FormatCount(test->count, "person");
}

Html DrawPublished(const StudyPageData& data) {
  const std::vector<ComparedValue>& published = data.result.statistics.published;
  if (published.empty()) return MakeParagraph("No measure of this study has a published value.");
  Table table("Comparison with published values.", {"Measure", "Here", "Published", "Source"});
  for (const ComparedValue& value : published) {
    const std::string over = value.factor.empty() ? "" : " over " + NameOfFactor(value.factor);
    table.AddRow({value.measure->name + over, DescribeOwn(value), value.published->text,
                  value.published->source});
  }
  return MakeParagraph(
             "Published values are for healthy adults reaching for objects on a table. Another "
             "task, population or opening measure than thumb to index (here " +
             MakeWords(data.result.study.config.analysis.opening.measure) +
             ") may give other values; large deviations are a reason to inspect trials.") +
         table.ToHtml();
}

}  // namespace

StudySection published_study_section() {
  return {"published", "Beside published values", DrawPublished};
}

}  // namespace graspbench
