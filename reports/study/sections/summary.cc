#include <cmath>

#include "core/base/range_text.h"
#include "core/base/text.h"
#include "human_study/study/trial_flags.h"
#include "human_study/study/trial_removal.h"
#include "reports/study/study_format.h"
#include "reports/study/study_section.h"

namespace graspbench {
namespace {

/** Smallest and largest median of the main measure over all choices. */
std::string DescribeRange(const StudyResult& result, const char* unit) {
  const UniverseSummary summary = SummariseUniverses(result.universes);
  if (summary.num_values < 2) return "";
  return " (" + FormatValue(summary.lowest, unit) + " to " + FormatWithUnit(summary.highest, unit) +
         " over " + std::to_string(summary.num_values) + " choices of the analysis)";
}

/** The same of the test's p and effect. */
std::string DescribeTestRange(const std::vector<Universe>& universes) {
  const UniverseSummary summary = SummariseUniverses(universes);
  if (summary.num_tests < 2) return "";
  return " (p " + FormatP(summary.lowest_p) + " to " + FormatP(summary.highest_p) +
         ", below 0.05 in " + std::to_string(summary.num_significant) + " of " +
         std::to_string(summary.num_tests) + " choices; eta squared " +
         FormatRange(summary.lowest_effect, summary.highest_effect, 2) + ")";
}

/** The study's main test in a sentence, or why there is none. */
std::string DescribeMainTest(const StudyResult& result) {
  if (result.universes.empty()) return "";
  const Universe& own = result.universes.front();
  const TrialMeasure& measure = FindMeasure(result.study.config.multiverse.measure);
  std::string text = std::string("Main measure: ") + measure.name + ", ";
  if (own.summary) {
    text += "median " + FormatWithUnit(own.summary->median, measure.unit) + " over " +
            FormatCount(own.summary->count, "trial") + DescribeRange(result, measure.unit) + ". ";
  } else {
    text += "no value (" + own.summary.reason() + "). ";
  }
  if (result.study.factors.empty()) return text + "The study names no factor to test.";
  const std::string factor = NameOfFactor(result.study.factors.front().name);
  if (!own.test) return text + "Effect of " + factor + ": not tested (" + own.test.reason() + ").";
  const double p = own.test->greenhouse_geisser.p;
  return text + "Effect of " + factor + ": F\u00A0=\u00A0" + FormatFixed(own.test->f, 2) +
         ", p\u00A0" + (p < 0.001 ? "" : "=\u00A0") + FormatP(p) +
         " (Greenhouse-Geisser), generalised eta squared " +
         FormatFixed(own.test->generalised_eta_squared, 2) + DescribeTestRange(result.universes) +
         ".";
}

/** What this recording cannot separate from touching at once. */
std::string DescribeZeroGft(const ZeroGft& zero) {
  if (zero.num_trials == 0) return "";
  return " GFT below " + FormatWithUnit(zero.limit, "s") +
         " cannot be told from zero here: digits that all touch at once would show a median of " +
         FormatWithUnit(zero.median, "s") + ".";
}

Html DrawFreeze(const Study& study) {
  if (!study.freeze) return {};
  Html text = Text(DescribeFreeze(study) + " ");
  if (!study.freeze->deviations.empty()) text += LinkTo("findings", "What deviates");
  return Element("p", {}, text);
}

/** The study's argument about the hand opening, and about digits that touch together. */
Html DrawArgument(const StudyResult& result) {
  if (result.CountKept() == 0) return {};
  return Element("p", {},
                 Text(DescribeOpeningArgument(result) + " ") +
                     LinkTo("openings", "All openings and criteria")) +
         Element("p", {},
                 Text(SayIndependence(result.statistics.independence) + " ") +
                     LinkTo("simultaneity", "GFT, clocks and power"));
}

/** Contacts that only the digit's own stop shows. */
Html DrawUnverified(const StudyResult& result) {
  const UnverifiedTouches touches = CountUnverified(result);
  if (touches.num_contacts == 0) return Html();
  return Element(
      "p", {},
      Text(
          "Touch not verifiable: " + FormatCount(touches.num_contacts, "contact") + " in " +
          FormatCount(touches.num_trials, "trial") +
          " of those that count. Without the object's shape (objects.csv) or a force, a digit that "
          "stops off the surface looks like one that touches."));
}

Html DrawMeasureTable(const StudyResult& result) {
  const Align number = Align::kNumber;
  Table table("Every measure over the trials that count.",
              {{"Measure"},
               {"n", number, "trials with a value"},
               {"Missing", number, "trials without"},
               {"Median", number},
               {"Quartiles", number},
               {"Mean", number},
               {"SD", number, "over trials, people and conditions together"}});
  for (const MeasureStatistics& row : result.statistics.measures) {
    const char* unit = row.measure.unit;
    if (!row.summary) {
      table.AddRow({Text(FormatHead(row.measure)), Text("0"),
                    Text(std::to_string(row.table.rows.size())), Text("n/a"), Text("n/a"),
                    Text("n/a"), Text("n/a")});
      continue;
    }
    const Summary& s = *row.summary;
    table.AddRow(
        {Text(FormatHead(row.measure)), Text(std::to_string(s.count)),
         Text(std::to_string(s.num_missing)), Text(FormatValue(s.median, unit)),
         Text(FormatValue(s.lower_quartile, unit) + " to " + FormatValue(s.upper_quartile, unit)),
         Text(FormatValue(s.mean, unit)),
         Text(FormatValue(s.standard_deviation.value_or(std::nan("")), unit))});
  }
  return table.ToHtml();
}

Html DrawSummary(const StudyPageData& data) {
  const StudyResult& result = data.result;
  const int num_trials = static_cast<int>(result.trials.size());
  const int num_removed = num_trials - result.CountKept();
  std::string reasons;
  if (num_removed > 0) {
    const RemovalGroup most = GroupRemoved(result.trials).front();
    reasons = (num_removed == 1 ? std::string(" (")
                                : " (most often, " + std::to_string(most.trials.size()) + ": ") +
              most.text + ")";
  }
  Html counts = Text(std::to_string(result.CountKept()) + " of " +
                     FormatCount(num_trials, "trial") + " were analysed");
  if (num_removed > 0) {
    counts += Text("; ") +
              LinkTo("removed", FormatCount(num_removed, "trial was", "trials were") + " removed") +
              Text(reasons);
  }
  return Element("p", {{"class", "verdict"}},
                 counts + Text(". " + DescribeMainTest(result) +
                               DescribeZeroGft(result.statistics.zero_gft))) +
         DrawFreeze(result.study) + DrawArgument(result) + DrawUnverified(result) +
         DrawMeasureTable(result);
}

}  // namespace

StudySection summary_study_section() { return {"summary", "Result", DrawSummary}; }

}  // namespace graspbench
