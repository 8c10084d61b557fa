#include <cmath>

#include "core/base/config.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/base/version.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

std::string ListDigitNames(const StudyResult& result) {
  std::string text;
  for (size_t i = 0; i < result.digits.size(); ++i) {
    text += i == 0 ? "" : i + 1 == result.digits.size() ? " and " : ", ";
    text += NameOfDigit(result.digits[i]);
  }
  return text;
}

/** Returns the text of an entry in one of the lists of rules. */
template <class List>
std::string TextOf(const List& list, const std::string& id) {
  for (const auto& entry : list) {
    if (entry.id == id) return entry.text;
  }
  return id;
}

std::string DescribeRecording(const StudyResult& result) {
  const StudyConfig& config = result.study.config;
  std::string text = "Markers on the tips of " + ListDigitNames(result) +
                     (config.markers.wrist.empty() ? "" : ", at the wrist") +
                     (config.markers.object.empty() ? "" : " and on the object") +
                     " were recorded at " + FormatFixed(result.rate, 1) + " Hz (median). ";
  if (config.cleaning.drop_frozen) text += "Repeated samples were discarded. ";
  if (result.num_resampled > 0) text += "Uneven time stamps were resampled linearly. ";
  text += "Gaps up to " + FormatValue(config.cleaning.max_gap, "s") +
          " ms were filled by cubic Hermite curves and flagged; longer gaps stayed open. ";
  std::string digits;
  for (int digit = 0; digit < PerDigit<int>::kNumDigits; ++digit) {
    if (config.markers.companions[digit].empty()) continue;
    digits += (digits.empty() ? "" : ", ") + std::string(NameOfDigit(digit));
  }
  if (digits.empty()) return text;
  return text + "Gaps up to " + FormatValue(config.cleaning.max_companion_gap, "s") +
         " ms of these tips were filled along a second marker on the digit and flagged: " + digits +
         ". ";
}

/** " (50 mm/s)"; empty for rules without a threshold. */
std::string DescribeThreshold(const MovementOptions& options) {
  if (options.rule == "regression" || options.rule == "multiplied") return "";
  const bool is_share = options.rule == "peak_fraction";
  return " (" +
         (is_share ? FormatWithUnit(options.peak_fraction, "1")
                   : FormatWithUnit(options.speed_threshold, "m/s")) +
         ")";
}

/** Describes the marker motion after contact that the fitted detectors learned from all
contacts. */
std::string DescribeDepth(const StudyResult& result) {
  if (result.num_learned == 0) return "";
  const double depth = CalcMeanDepth(result.study.config.analysis.contact.depths);
  return ". The marker motion after contact was learned from " +
         FormatCount(result.num_learned, "contact") + " of the study, " +
         FormatFixed(MmFromM(depth), 1) + " mm on average";
}

std::string DescribeEvents(const StudyResult& result) {
  const AnalysisOptions& options = result.study.config.analysis;
  const bool has_object = !result.study.config.markers.object.empty();
  std::string text =
      "All filters were zero-phase second-order Butterworth filters, corrected for two passes: " +
      FormatSignificant(options.movement.cutoff, 3) + " Hz for the movement, " +
      FormatSignificant(options.opening.cutoff, 3) + " Hz for the hand opening, " +
      FormatSignificant(options.contact.cutoff, 3) + " Hz for contacts" +
      (has_object ? ", " + FormatSignificant(options.contact.object_cutoff, 3) +
                        " Hz for the object's pose, " +
                        FormatSignificant(options.lift_off.cutoff, 3) + " Hz for its lift-off"
                  : "") +
      (ListCutoffs(FitCutoffs(options, result.lowest_rate)) == ListCutoffs(options)
           ? ""
           : "; of slower recordings at most " + FormatSignificant(kMaxCutoffShare, 2) +
                 " of their rate") +
      ". Onset and end of the movement: " + TextOf(MovementRuleList(), options.movement.rule) +
      DescribeThreshold(options.movement) +
      ". First contact of each digit: " + TextOf(ContactDetectorList(), options.contact.detector) +
      DescribeDepth(result) +
      ". Hand opening: " + TextOf(HandOpeningList(), options.opening.measure) +
      "; closure starts at its " + options.opening.maximum + " maximum. ";
  if (has_object) {
    const std::string& rule = options.lift_off.rule;
    text += "Lift-off: " + TextOf(LiftOffRuleList(), rule);
    if (rule == "rise") text += " (" + FormatWithUnit(options.lift_off.rise, "m") + ")";
    if (rule == "traced_back") text += " (" + FormatWithUnit(options.lift_off.speed, "m/s") + ")";
    text += ". ";
  }
  text += "Contacts were searched backwards from the hold: the lift-off, or without a lift the " +
          TextOf(HoldRuleList(), options.hold.rule) + ". ";
  return text +
         "Grasp forming time (GFT) is the time from the first to the last of the first contacts, "
         "grasp opposing time (GOT) that between the thumb and the earliest finger, grasp closure "
         "time (GCT) that from the widest opening to the last contact; GFT% and GOT% are their "
         "shares of GCT. ";
}

/** Describes the analyses beyond the comparison of conditions. */
std::string DescribeTrends(const Study& study) {
  std::string quantities, bounds;
  for (const Factor& factor : study.factors) {
    if (factor.numbers.empty()) continue;
    quantities += (quantities.empty() ? "" : " and ") + NameOfFactor(factor.name);
  }
  for (const Hypothesis& hypothesis : study.hypotheses) {
    if (std::isnan(hypothesis.equal_within)) continue;
    const TrialMeasure& measure = FindMeasure(hypothesis.measure);
    bounds += (bounds.empty() ? "" : ", ") + FormatWithUnit(hypothesis.equal_within, measure.unit) +
              " for " + measure.name;
  }
  std::string text;
  if (!quantities.empty()) {
    text += "Trends over " + quantities +
            " were estimated in two ways: a straight line through each person's trials, the "
            "slopes then tested over persons; and a linear mixed model with an intercept and a "
            "slope for each person, fitted to all trials by restricted maximum likelihood, "
            "degrees of freedom after Satterthwaite. ";
  }
  text += "Mean differences " + std::string(quantities.empty() ? "" : "and slopes ") +
          "also have bias-corrected and accelerated (BCa) bootstrap intervals from 9999 draws of "
          "persons. ";
  if (!bounds.empty()) {
    text += "Equivalence of conditions was tested by two one-sided t tests with bounds of " +
            bounds + ". ";
  }
  return text;
}

std::string DescribeStatistics(const StudyResult& result) {
  std::string text =
      std::to_string(result.trials.size() - static_cast<size_t>(result.CountKept())) + " of " +
      std::to_string(result.trials.size()) + " trials were removed. ";
  if (result.study.factors.empty() && result.study.groups.empty()) return text;
  std::string factors;
  for (const auto* list : {&result.study.factors, &result.study.groups}) {
    for (const Factor& factor : *list) {
      factors += (factors.empty() ? "" : " and ") + NameOfFactor(factor.name) + " (" +
                 FormatCount(static_cast<int>(factor.levels.size()), "level") +
                 (list == &result.study.groups ? ", between persons)" : ")");
    }
  }
  return text +
         "The unit of analysis is the mean of a person's trials in a condition. Effects of " +
         factors + " were tested by " +
         (result.study.groups.empty() ? "repeated-measures" : "mixed") +
         " analysis of variance (sums of squares of type III) with Greenhouse-Geisser correction, "
         "by a linear mixed model of all trials (restricted maximum likelihood, the fullest random "
         "part that is not singular, degrees of freedom after Satterthwaite) and by Friedman's "
         "test; pairs of conditions by paired t "
         "tests and exact Wilcoxon signed-rank tests, p values adjusted after Holm. Effect sizes "
         "are generalised eta squared, d_z, Kendall's W and the rank-biserial correlation. " +
         DescribeTrends(result.study);
}

/** Describes how the two arguments on the study's first page are derived. */
std::string DescribeArguments(const StudyResult& result) {
  std::string text;
  if (result.statistics.openings.num_tests > 0) {
    text +=
        "Measures of hand opening were compared with the aperture on the same trials by ratios of "
        "four criteria (F of persons, d' of the open and the closed hand, slope over the within-"
        "person standard deviation, d' without the digit whose loss costs most), with intervals "
        "from the jackknife over persons on the logarithm and p values adjusted after Holm. ";
  }
  if (!result.statistics.independence) return text;
  return text +
         "GFT was compared with that of independent digits: the contact times of each digit were "
         "permuted 999 times among the trials of one person and condition. Times were counted from "
         "the onset, from the widest opening, and from the onset after removing the movement "
         "duration; the uncertainty of these clocks was removed from the permuted spread. ";
}

Html DrawMethods(const StudyPageData& data) {
  const StudyResult& result = data.result;
  return MakeMethodsText({DescribeRecording(result), DescribeEvents(result),
                          DescribeStatistics(result) + DescribeArguments(result) +
                              "The analysis was made with graspbench " + program_version() + "."}) +
         MakeParagraph(
             "Known from the thesis: the names of GCT, GFT, GOT and their ratios, and the widest "
             "opening as the start of closure. Inferred: their formulas. Proposed by graspbench: "
             "detectors, default hand opening, thresholds and cut-offs.") +
         MakeDetails("All settings",
                     MakeConfigTable("The study's complete settings; null is \"not given\".",
                                     ConfigToJson(result.study.config)));
}

}  // namespace

StudySection methods_study_section() { return {"methods", "Methods and settings", DrawMethods}; }

}  // namespace graspbench
