#include "workbench/text/study_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "human_study/study/run/trial_removal.h"
#include "reports/study/contrast.h"
#include "workbench/experiments/machines/shell_quote.h"

namespace graspbench {
namespace {

std::string FormatErrors(const Answer<Summary>& errors) {
  if (!errors) return errors.reason();
  return "bias " + FormatFixed(MsFromS(errors->mean), 1) + " ms, SD " +
         FormatFixed(MsFromS(errors->standard_deviation.value_or(std::nan(""))), 1) + " ms, n " +
         std::to_string(errors->count);
}

std::string FormatTrials(const RemovalGroup& group) {
  constexpr size_t kNamed = 6;
  std::string names;
  for (size_t i = 0; i < group.trials.size() && i < kNamed; ++i) {
    names += (i > 0 ? ", " : "") + group.trials[i];
  }
  if (group.trials.size() > kNamed) names += " ..";
  return "         trials: " + names + "\n";
}

/** Where half of the trials were looked at and do not count. */
std::string FormatAdvice(const StudyResult& result) {
  const auto num_lost =
      std::count_if(result.trials.begin(), result.trials.end(),
                    [](const StudyTrial& trial) { return trial.analysis && !trial.IsKept(); });
  if (num_lost == 0 || 2 * static_cast<size_t>(num_lost) < result.trials.size()) return "";
  const Study& study = result.study;
  const bool is_elsewhere = study.recordings != study.folder;
  return "advice   graspbench study suggest " + QuoteForShell(study.file) +
         (is_elsewhere ? " --data " + QuoteForShell(study.recordings.string()) : "") +
         " proposes keys with which more trials are included\n";
}

/** Whether the choices are the frozen ones, a line for each that is not; empty without a freeze. */
std::string FormatFreeze(const Study& study) {
  if (!study.freeze) return "";
  std::string text = "frozen   " + DescribeFreeze(study) + "\n";
  for (const std::string& deviation : ListDeviations(study)) text += "deviates " + deviation + "\n";
  return text;
}

std::string FormatFindings(const StudyResult& result) {
  const ZeroGft& zero = result.statistics.zero_gft;
  std::string text;
  if (zero.num_trials > 0) {
    text += "limit    the GFT of a trial below " + FormatFixed(MsFromS(zero.limit), 0) +
            " ms cannot be told from 0; simultaneous contacts would show a median of " +
            FormatFixed(MsFromS(zero.median), 0) + " ms\n";
  }
  if (result.CountKept() == 0) return text;
  for (std::string contrast : DescribeContrasts(result)) {
    constexpr std::string_view kNoBreak = "\u00A0";  // of the page
    for (size_t at = 0; (at = contrast.find(kNoBreak, at)) != contrast.npos;) {
      contrast.replace(at, kNoBreak.size(), " ");
    }
    text += "effect   " + contrast + "\n";
  }
  return text + "opening  " + DescribeOpeningArgument(result) + "\ntogether " +
         DescribeIndependence(result.statistics.independence) + "\n";
}

}  // namespace

std::string FormatRemoved(const StudyResult& result) {
  std::string text = result.CountKept() == 0 ? "no trial counts:\n" : "";
  for (const RemovalGroup& group : GroupRemoved(result.trials)) {
    text += fmt::format("removed  {} [{}] {}\n", group.trials.size(), group.code, group.text) +
            FormatTrials(group) + "         keys: " + FindRemovalAdvice(group.code).keys + "\n";
  }
  return text + FormatAdvice(result);
}

std::string FormatStudy(const StudyResult& result, const std::filesystem::path& folder,
                        const std::filesystem::path& report) {
  return FormatFreeze(result.study) + FormatRemoved(result) + FormatWarnings(result) +
         FormatFindings(result) + "kept     " + std::to_string(result.CountKept()) + " of " +
         FormatCount(static_cast<int>(result.trials.size()), "trial") + "\ntables   " +
         (folder / "measures.csv").string() + "\nR        " + (folder / "tidy").string() +
         "\nBIDS     " + (folder / "bids").string() + "\nreport   " + report.string() + "\n";
}

Json MakeStudyJson(const StudyResult& result, const std::filesystem::path& folder,
                   const std::filesystem::path& report) {
  Json removed = Json::array();
  for (const RemovalGroup& group : GroupRemoved(result.trials)) {
    removed.push_back(
        {{"code", group.code}, {"trials", group.trials.size()}, {"reason", group.text}});
  }
  return {{"study", folder.string()},
          {"report", report.string()},
          {"measures", (folder / "measures.csv").string()},
          {"trials", result.trials.size()},
          {"kept", result.CountKept()},
          {"removed", removed},
          {"warnings", result.warnings.size()}};
}

std::string FormatSuggestions(const StudySuggestions& suggestions) {
  std::string text = fmt::format("now      {} of {} included", suggestions.num_kept,
                                 FormatCount(suggestions.num_trials, "trial"));
  if (suggestions.num_rows < suggestions.num_all_rows) {
    text += fmt::format(", tried on {} of {} rows of trials.csv to save time", suggestions.num_rows,
                        suggestions.num_all_rows);
  }
  text += "\n";
  for (const Suggestion& suggestion : suggestions.suggestions) {
    for (const std::string& setting : suggestion.settings) {
      const size_t equals = setting.find('=');
      text +=
          fmt::format("suggest  {}: {}\n", setting.substr(0, equals), setting.substr(equals + 1));
    }
    text +=
        fmt::format("         why: {}\n         cost: {}\n         then {} included\n",
                    suggestion.reason, suggestion.cost, FormatCount(suggestion.num_kept, "trial"));
  }
  if (suggestions.suggestions.empty()) text += "suggest  nothing: no key includes more trials\n";
  text += fmt::format("then     {} of {} included\n", suggestions.num_kept_then,
                      FormatCount(suggestions.num_trials_then, "trial"));
  for (const RemovalGroup& group : suggestions.others) {
    text += fmt::format("left     {} [{}] {}\n", group.trials.size(), group.code, group.text) +
            FormatTrials(group);
    // No setting that was tried mends it.
    const std::string advice = FindAdviceBeyondSettings(group.code);
    if (!advice.empty()) text += "         look at: " + advice + "\n";
  }
  return text;
}

std::string FormatWarnings(const StudyResult& result) {
  constexpr int kShown = 3;  // of a kind
  std::map<std::string, int> counts;
  std::string text;
  for (const StudyWarning& warning : result.warnings) {
    if (++counts[warning.code] <= kShown) {
      text += fmt::format("warning  [{}] {}\n", warning.code, warning.text);
    }
  }
  for (const auto& [code, count] : counts) {
    if (count > kShown) text += fmt::format("warning  [{}] and {} more\n", code, count - kShown);
  }
  return text;
}

std::string FormatTruth(const TruthComparison& comparison) {
  return "truth    found - true, over the included trials\n  movement onset  " +
         FormatErrors(comparison.onset) + "\n  widest opening  " +
         FormatErrors(comparison.closure_start) + "\n  first contacts  " +
         FormatErrors(comparison.contact) + "\n  GFT             " + FormatErrors(comparison.gft) +
         "\n";
}

}  // namespace graspbench
