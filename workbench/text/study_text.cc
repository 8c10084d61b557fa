#include "workbench/text/study_text.h"

#include <fmt/core.h>

#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "human_study/study/run/trial_removal.h"

namespace graspbench {
namespace {

std::string FormatErrors(const Answer<Summary>& errors) {
  if (!errors) return errors.reason();
  return "bias " + FormatFixed(MsFromS(errors->mean), 1) + " ms, SD " +
         FormatFixed(MsFromS(errors->standard_deviation.value_or(std::nan(""))), 1) + " ms, n " +
         std::to_string(errors->count);
}

}  // namespace

std::string FormatRemoved(const StudyResult& result) {
  std::string text = result.CountKept() == 0 ? "no trial counts:\n" : "";
  for (const RemovalGroup& group : GroupRemoved(result.trials)) {
    text += fmt::format("removed  {} [{}] {}\n", group.trials.size(), group.code, group.text);
  }
  return text;
}

std::string FormatWarnings(const StudyResult& result) {
  std::string text;
  for (const StudyWarning& warning : result.warnings) {
    text += fmt::format("warning  [{}] {}\n", warning.code, warning.text);
  }
  return text;
}

std::string FormatFreeze(const Study& study) {
  if (!study.freeze) return "";
  std::string text = "frozen   " + DescribeFreeze(study) + "\n";
  for (const std::string& deviation : ListDeviations(study)) text += "deviates " + deviation + "\n";
  return text;
}

std::string FormatZeroGft(const ZeroGft& zero) {
  if (zero.num_trials == 0) return "";
  return "zero     GFT below " + FormatFixed(MsFromS(zero.limit), 0) +
         " ms cannot be told from zero here; touching at once would show a median of " +
         FormatFixed(MsFromS(zero.median), 0) + " ms\n";
}

std::string FormatOpeningArgument(const StudyResult& result) {
  if (result.CountKept() == 0) return "";
  return "opening  " + DescribeOpeningArgument(result) + "\n";
}

std::string FormatIndependence(const StudyResult& result) {
  if (result.CountKept() == 0) return "";
  return "together " + DescribeIndependence(result.statistics.independence) + "\n";
}

std::string FormatTruth(const TruthComparison& comparison) {
  return "truth    found - true over the trials that count\n  movement onset  " +
         FormatErrors(comparison.onset) + "\n  widest opening  " +
         FormatErrors(comparison.closure_start) + "\n  first contacts  " +
         FormatErrors(comparison.contact) + "\n  GFT             " + FormatErrors(comparison.gft) +
         "\n";
}

}  // namespace graspbench
