#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "human_study/study/run/trial_removal.h"
#include "reports/study/study_format.h"
#include "reports/study/trial_figures.h"

namespace graspbench {
namespace {

constexpr int kMaxNamed = 12;

std::string ListNames(const std::vector<std::string>& names) {
  std::string text;
  for (size_t i = 0; i < names.size() && i < kMaxNamed; ++i) text += (i ? ", " : "") + names[i];
  if (names.size() > kMaxNamed) {
    text += " and " + std::to_string(names.size() - kMaxNamed) + " more";
  }
  return text;
}

/** Draws the first trial of each reason for removal that a curve can show. */
Html DrawReasons(const StudyResult& result, const std::vector<RemovalGroup>& groups) {
  constexpr size_t kMaxCurves = 6;
  Html html;
  size_t num_drawn = 0;
  for (const RemovalGroup& group : groups) {
    const RemovalAdvice& advice = FindRemovalAdvice(group.code);
    const auto trial =
        std::find_if(result.trials.begin(), result.trials.end(),
                     [&](const StudyTrial& t) { return t.id == group.trials.front(); });
    if (advice.curve == RemovalCurve::kNone || !trial->analysis || num_drawn == kMaxCurves)
      continue;
    ++num_drawn;
    html += MakeFigure("Why trial " + trial->id + " does not count: " + trial->removed + ".",
                       std::string("relevant keys: ") + advice.keys + ".",
                       DrawDecidingCurve(*trial, result.study.config.analysis.movement));
  }
  return html;
}

Html DrawRemoved(const StudyResult& result) {
  const std::vector<RemovalGroup> groups = GroupRemoved(result.trials);
  if (groups.empty()) return MakeParagraph("No trial was removed.");
  Table table("Removed trials by reason; trials.csv lists all.",
              {"Code",
               "Reason",
               {"Relevant keys", "keys of study.yaml, columns of its tables"},
               "Trials",
               "Which"});
  for (const RemovalGroup& group : groups) {
    table.AddRow({Element("code", {}, group.code), group.text, FindRemovalAdvice(group.code).keys,
                  group.trials.size(), ListNames(group.trials)});
  }
  return MakeParagraph(
             "graspbench study suggest STUDY.YAML proposes settings that include more trials, with "
             "reasons.") +
         table.ToHtml() + DrawReasons(result, groups);
}

Html DrawFlags(const StudyResult& result) {
  Table table("Trials included with warnings; study.yaml can remove them (removal).",
              {"Flag", "Trials", "Share of included trials"});
  std::vector<std::string> unused;
  for (const FlagCount& counted : CountFlags(result)) {
    if (counted.count == 0) {
      unused.emplace_back(counted.flag->text);
      continue;
    }
    table.AddRow({counted.flag->text, counted.count, FormatPercent(counted.share)});
  }
  const bool has_rows = unused.size() < CountFlags(result).size();
  Html html = has_rows ? table.ToHtml() : MakeParagraph("No included trial has a warning.");
  if (unused.empty()) return html;
  return html + MakeDetails("Checks that found nothing (" + std::to_string(unused.size()) + ")",
                            MakeList(unused));
}

Html DrawImport(const StudyResult& result) {
  const std::vector<FindingGroup> groups = GroupFindings(result);
  Html html = MakeParagraph(
      std::to_string(result.num_frozen) +
      " samples repeated the previous sample exactly and were " +
      (result.study.config.cleaning.drop_frozen ? "taken as missing; " : "kept; ") +
      FormatCount(result.num_resampled, "recording") + " had uneven time stamps and " +
      (result.num_resampled == 1 ? "was" : "were") + " resampled.");
  if (groups.empty()) return html + MakeParagraph("Reading the files needed no assumption.");
  Table table(
      "Assumptions needed to read the files; assumptions that differ only in numbers share a row.",
      {"Code", "Assumption", "Times", "Files"});
  for (const FindingGroup& group : groups) {
    table.AddRow(
        {Element("code", {}, group.code), group.text, group.count, ListNames(group.files)});
  }
  return html + table.ToHtml();
}

Html DrawRemoved(const StudyPageData& data) {
  return DrawRemoved(data.result) + Element("h3", {}, "Flags") + DrawFlags(data.result) +
         Element("h3", {}, "Reading and cleaning") + DrawImport(data.result);
}

}  // namespace

StudySection removed_study_section() { return {"removed", "Trials removed, and why", DrawRemoved}; }

}  // namespace graspbench
