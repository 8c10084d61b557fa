#include <cmath>

#include "core/base/text/text.h"
#include "human_study/study/run/trial_removal.h"
#include "reports/study/contrast.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

/** Smallest and largest median of the main measure over all choices. */
std::string DescribeRange(const StudyResult& result, const char* unit) {
  const UniverseSummary summary = SummariseUniverses(result.universes);
  if (summary.num_values < 2) return "";
  return " (" + FormatValue(summary.lowest, unit) + " to " + FormatWithUnit(summary.highest, unit) +
         " over " + std::to_string(summary.num_values) + " choices of the analysis)";
}

/** Smallest and largest p and effect of the test over all choices. */
std::string DescribeTestRange(const std::vector<Universe>& universes) {
  const UniverseSummary summary = SummariseUniverses(universes);
  if (summary.num_tests < 2) return "";
  const std::string lowest = FormatP(summary.lowest_p), highest = FormatP(summary.highest_p);
  return " (p " + lowest + (lowest == highest ? "" : " to " + highest) + ", below 0.05 in " +
         std::to_string(summary.num_significant) + " of " + std::to_string(summary.num_tests) +
         " choices; eta squared " + FormatRange(summary.lowest_effect, summary.highest_effect, 2) +
         ")";
}

/** "F(1.8, 12.3) = 4.56". */
std::string FormatF(double f, double df_effect, double df_error) {
  const auto format = [](double df) {
    return FormatFixed(df, std::abs(df - std::round(df)) < 0.005 ? 0 : 2);
  };
  return "F(" + format(df_effect) + ", " + format(df_error) + ")\u00A0=\u00A0" + FormatFixed(f, 2);
}

/** Describes who is missing from the main test and what the mixed model finds with them. */
std::string DescribeLeftOut(const StudyResult& result) {
  const std::string& main = result.study.config.multiverse.measure;
  for (const MeasureStatistics& measure : result.statistics.measures) {
    if (measure.measure.id != main || !measure.cells || measure.cells->left_out.empty()) continue;
    const int count = static_cast<int>(measure.cells->left_out.size());
    std::string text =
        " It leaves out " + FormatCount(count, "person") + " without a value in some condition; ";
    if (!measure.model) return text + "no mixed model keeps them (" + measure.model.reason() + ").";
    const Answer<RemlFTest>& test = measure.model->effects.front().test;
    if (!test) return text + "no mixed model keeps them (" + test.reason() + ").";
    return text + "the mixed model of all " +
           FormatCount(measure.model->num_observations, "trial") +
           " keeps them: " + FormatF(test->f, test->df_1, test->df_2) + ", p\u00A0" +
           (test->p < 0.001 ? "" : "=\u00A0") + FormatP(test->p) + ".";
  }
  return "";
}

/** Describes the result of the study's main test in a sentence, or why there is none. */
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
  if (result.study.factors.empty() && result.study.groups.empty()) {
    return text + "The study names no factor to test.";
  }
  const std::vector<Factor>& tested =
      result.study.factors.empty() ? result.study.groups : result.study.factors;
  const std::string factor = NameOfFactor(tested.front().name);
  if (!own.test) return text + "Effect of " + factor + ": not tested (" + own.test.reason() + ").";
  const CorrectedF& corrected = own.test->greenhouse_geisser;
  const double p = corrected.p;
  return text + "Effect of " + factor + ": " +
         FormatF(own.test->f, corrected.df_effect, corrected.df_error) + ", p\u00A0" +
         (p < 0.001 ? "" : "=\u00A0") + FormatP(p) +
         " (Greenhouse-Geisser), generalised eta squared " +
         FormatFixed(own.test->generalised_eta_squared, 2) + DescribeTestRange(result.universes) +
         "." + DescribeLeftOut(result);
}

/** Describes the recording's detection limit for near-simultaneous contact. */
std::string DescribeZeroGft(const ZeroGft& zero) {
  if (zero.num_trials == 0) return "";
  return " The detection limit of the GFT is " + FormatWithUnit(zero.limit, "s") +
         " here: simultaneous contact would show a median of " + FormatWithUnit(zero.median, "s") +
         ".";
}

/** Lists the warnings that a reader should know before the numbers. */
Html DrawStudyWarnings(const StudyResult& result) {
  Html warnings;
  for (const StudyWarning& warning : result.warnings) {
    warnings += Element("p", {},
                        Element("strong", {}, "Warning") + Text(" ") +
                            Element("code", {}, warning.code) + Text(": " + warning.text + "."));
  }
  return warnings;
}

Html DrawFreeze(const Study& study) {
  if (!study.freeze) return {};
  Html text = Text(DescribeFreeze(study) + " ");
  if (!study.freeze->deviations.empty()) text += LinkTo("findings", "What deviates");
  return Element("p", {}, text);
}

/** States the study's argument about the hand opening and about simultaneous contact. */
Html DrawArgument(const StudyResult& result) {
  if (result.CountKept() == 0) return {};
  return Element("p", {},
                 Text(DescribeOpeningArgument(result) + " ") +
                     LinkTo("openings", "All openings and criteria")) +
         Element("p", {},
                 Text(SayIndependence(result.statistics.independence) + " ") +
                     LinkTo("simultaneity", "GFT, clocks and power"));
}

/** Lists what a reviewer confirmed or corrected, trial by trial. */
Html DrawReviewed(const StudyResult& result) {
  int num_contacts = 0, num_changed = 0;
  std::vector<std::string> lines;
  for (const StudyTrial& trial : result.trials) {
    if (trial.reviews.empty()) continue;
    lines.push_back(trial.id + ": " + DescribeReviews(trial.reviews));
    for (const ContactReview& review : trial.reviews) {
      ++num_contacts;
      num_changed += review.verdict != ReviewVerdict::kConfirmed;
    }
  }
  if (lines.empty()) return {};
  return MakeParagraph("A reviewer inspected " + FormatCount(num_contacts, "contact") + " of " +
                       FormatCount(static_cast<int>(lines.size()), "trial") + " and changed " +
                       std::to_string(num_changed) +
                       "; reviewed contacts are the same under every choice of the analysis.") +
         MakeDetails("Reviewed trials", MakeList(lines));
}

/** States the limits of a recording with a thumb and one finger. */
Html DrawTwoDigits(const StudyResult& result) {
  if (result.digits.size() != 2) return {};
  return MakeParagraph(
      "Two digits were recorded, so GFT equals GOT and does not describe the other digits.");
}

/** Counts the contacts that only the stop of the digit itself indicates. */
Html DrawUnverified(const StudyResult& result) {
  const UnverifiedTouches touches = CountUnverified(result);
  if (touches.num_contacts == 0) return Html();
  return Element("p", {},
                 Text("Touch not verifiable: " + FormatCount(touches.num_contacts, "contact") +
                      " in " + FormatCount(touches.num_trials, "included trial") +
                      ". Without the object's shape (objects.csv) or a "
                      "force, a digit that stops off the surface looks like a contact."));
}

/** Formats the range of the median over all choices of the analysis. */
std::string FormatChoices(const MeasureStatistics& measure) {
  const ChoiceRange& range = measure.over_choices;
  if (range.num_values < 2) return "";
  return FormatValue(range.lowest, measure.measure.unit) + " to " +
         FormatValue(range.highest, measure.measure.unit);
}

Html DrawMeasureTable(const StudyResult& result) {
  if (result.CountKept() == 0) return {};
  Table table(
      "All measures over the included trials.",
      {"Measure",
       {"n", "trials with a value"},
       {"Missing", "trials without"},
       "Median",
       {"Median over all choices", "smallest and largest over the combinations of the multiverse"},
       "Quartiles",
       "Mean",
       {"SD", "over all trials, persons and conditions"}});
  for (const MeasureStatistics& row : result.statistics.measures) {
    const char* unit = row.measure.unit;
    if (!row.summary) {
      table.AddRow({FormatHead(row.measure), "0", row.table.rows.size(), "n/a", FormatChoices(row),
                    "n/a", "n/a", "n/a"});
      continue;
    }
    const Summary& s = *row.summary;
    table.AddRow(
        {FormatHead(row.measure), s.count, s.num_missing, FormatValue(s.median, unit),
         FormatChoices(row),
         FormatValue(s.lower_quartile, unit) + " to " + FormatValue(s.upper_quartile, unit),
         FormatValue(s.mean, unit),
         FormatValue(s.standard_deviation.value_or(std::nan("")), unit)});
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
  return DrawContrast(result) +
         Element("p", {{"class", "verdict"}},
                 counts + Text(". " + DescribeMainTest(result) +
                               DescribeZeroGft(result.statistics.zero_gft))) +
         DrawStudyWarnings(result) + DrawFreeze(result.study) + DrawArgument(result) +
         DrawTwoDigits(result) + DrawReviewed(result) + DrawUnverified(result) +
         DrawContrastTable(result) + DrawMeasureTable(result);
}

}  // namespace

StudySection summary_study_section() { return {"summary", "Result", DrawSummary}; }

}  // namespace graspbench
