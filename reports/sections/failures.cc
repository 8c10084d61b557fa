#include <algorithm>

#include "core/base/text/text.h"
#include "datasets/session/explanation_store.h"
#include "datasets/session/find_trial.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/scenes/cell_pictures.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

constexpr size_t kMaxRows = 300;

/** Lists the failures that have a row in the value table of their cell, in the order of the
plan. */
std::vector<const TrialRecord*> ListFailures(const SessionSummary& summary) {
  std::vector<const TrialRecord*> failures;
  for (const CellSummary& cell : summary.cells) {
    if (!IsDrawnInFull(cell, summary)) continue;
    for (const TrialRecord* record : ChooseShownTrials(cell, summary)) {
      if (!IsSuccess(record->result.outcome)) failures.push_back(record);
    }
  }
  return failures;
}

/** Links to the trial's scene or, on a page without it, to the instructions for making one. */
Html LinkToView(const ReportData& data, const PlannedTrial& planned) {
  const std::string anchor = MakeViewAnchor(planned);
  const bool has_view = data.views.body.markup().find("id=\"" + anchor + "\"") != std::string::npos;
  return LinkTo(has_view                  ? anchor
                : data.views.body.empty() ? "further"
                                          : "views",
                has_view ? "show" : "how");
}

/** States how many failures are explained and how to explain more. */
Html DescribeExplained(const Explanations& known, const std::vector<const TrialRecord*>& failures) {
  const auto num_explained =
      std::count_if(failures.begin(), failures.end(),
                    [&](const TrialRecord* record) { return known.count(record->plan.id) > 0; });
  return Element(
      "p", {},
      Text("By default, the report explains one failure per condition, in at most " +
           std::to_string(kMostShortly) + " conditions, with a few remedies on " +
           std::to_string(kNumFirstDraws) + " fresh draws. More remedies on " +
           std::to_string(kNumFreshDraws) + " draws: ") +
          Element("code", {}, "graspbench explain FOLDER") + Text(", with ") +
          Element("code", {}, "--all") +
          Text(" of every failure. Here " + std::to_string(num_explained) + " of " +
               FormatCount(static_cast<int64_t>(failures.size()), "failure is", "failures are") +
               " explained."));
}

/** Formats how many fresh draws held with the trial's own settings: "3 of 10". */
std::string FormatHeld(const Explanation* explanation) {
  if (!explanation) return "not explained";
  return std::to_string(explanation->num_held()) + " of " +
         std::to_string(explanation->num_draws());
}

/** Names the failure mechanism, or the reason when the trial ended before one could be found. */
std::string NameMechanism(const TrialResult& result) {
  return result.diagnosis ? NameOf(result.diagnosis->mechanism) : result.reason;
}

Html DrawFailedTrials(const ReportData& data) {
  const Tally& total = data.summary.total;
  if (total.finished == total.successes()) return MakeParagraph("No finished trial failed.");
  const std::vector<const TrialRecord*> failures = ListFailures(data.summary);
  const Explanations known = LoadExplanations(data.session.folder);
  const size_t num_rows = std::min(failures.size(), kMaxRows);
  Table table("All failed trials, with mechanism and remedies.",
              {{"Trial", "links to all values of the trial"},
               {"3-D", "links to its scene, or to the command that makes it"},
               "Outcome",
               {"Mechanism", "how the object was lost"},
               {"Time [s]", "time of the loss since the start of placing"},
               {"Fresh draws that succeed", "new draws of the condition, without a remedy"},
               {"With a remedy", "remedies with the largest net gain on the same fresh draws"}});
  for (size_t i = 0; i < num_rows; ++i) {
    const PlannedTrial& planned = failures[i]->plan;
    const TrialResult& result = failures[i]->result;
    const auto at = known.find(planned.id);
    const Explanation* explanation = at == known.end() ? nullptr : &at->second;
    table.AddRow({LinkTo(MakeTrialAnchor(planned), NameTrial(planned)), LinkToView(data, planned),
                  WordsOf(result.outcome), NameMechanism(result),
                  result.diagnosis ? FormatFixed(result.diagnosis->time, 3) : "-",
                  FormatHeld(explanation),
                  explanation ? SummariseExplanation(*explanation) : "not explained"});
  }
  Html html = Element("p", {},
                      Text("The name of a trial links to its values and a description of forces "
                           "and works. All remedies and pictures: ") +
                          Element("code", {}, "graspbench trial FOLDER TRIAL --page trial.html") +
                          Text(", with the session's folder and a name from the first column."));
  const int num_all = total.finished - total.successes();
  if (static_cast<size_t>(num_all) > num_rows) {
    html += MakeParagraph(std::to_string(num_rows) + " of " + FormatCount(num_all, "trial") +
                          "; export/trials.csv has all of them.");
  }
  return Element("div", {{"class", "screen"}},
                 html + DescribeExplained(known, failures) + table.ToHtml()) +
         Element("p", {{"class", "print"}},
                 FormatCount(num_all, "trial") + " failed; export/trials.csv names them.");
}

}  // namespace

Section failures_section() { return {"failures", "Trials that failed", DrawFailedTrials}; }

}  // namespace graspbench
