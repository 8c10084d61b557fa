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

/** Those that have a row among the values of their cell, in the plan's order. */
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

/** To its scene, or, of a page without, to what makes one. */
Html LinkToView(const ReportData& data, const PlannedTrial& planned) {
  const std::string anchor = MakeViewAnchor(planned);
  const bool has_view = data.views.body.markup().find("id=\"" + anchor + "\"") != std::string::npos;
  return LinkTo(has_view ? anchor : "views", has_view ? "show" : "how");
}

/** What the session's explanations say of those in the table. */
Html DrawExplanations(const ReportData& data, const std::vector<const TrialRecord*>& failures) {
  const Explanations known = LoadExplanations(data.session.folder);
  Table table("What would have held, found by running failed trials again.",
              {{"Trial", "leads to all its values"}, "Remedies"});
  int num_explained = 0;
  for (const TrialRecord* record : failures) {
    const auto explained = known.find(record->plan.id);
    if (explained == known.end()) continue;
    ++num_explained;
    table.AddRow({LinkTo(MakeTrialAnchor(record->plan), NameTrial(record->plan)),
                  DescribeExplanation(explained->second)});
  }
  const Html how =
      Element("p", {},
              Text("Of each condition at most one failure is explained unless "
                   "all are asked for: ") +
                  Element("code", {}, "graspbench explain FOLDER --all") +
                  Text(". Here: " + std::to_string(num_explained) + " of " +
                       FormatCount(static_cast<int64_t>(failures.size()), "failure") + "."));
  return num_explained > 0 ? how + table.ToHtml() : how;
}

Html DrawFailedTrials(const ReportData& data) {
  const Tally& total = data.summary.total;
  if (total.finished == total.successes()) return MakeParagraph("No finished trial failed.");
  const std::vector<const TrialRecord*> failures = ListFailures(data.summary);
  const size_t num_rows = std::min(failures.size(), kMaxRows);
  Table table("Every trial that did not succeed, and why.",
              {{"Trial", "leads to all its values"},
               {"3-D", "leads to its scene, or says how to make it"},
               "Outcome",
               "Why"});
  for (size_t i = 0; i < num_rows; ++i) {
    const PlannedTrial& planned = failures[i]->plan;
    table.AddRow({LinkTo(MakeTrialAnchor(planned), NameTrial(planned)), LinkToView(data, planned),
                  WordsOf(failures[i]->result.outcome), ExplainEnd(failures[i]->result)});
  }
  Html html =
      Element("p", {},
              Text("What happened in one of them, step by step, with forces and a picture: ") +
                  Element("code", {}, "graspbench trial FOLDER TRIAL --render trial.png") +
                  Text(", with the session's folder and a name of the first column."));
  const int num_all = total.finished - total.successes();
  if (static_cast<size_t>(num_all) > num_rows) {
    html += MakeParagraph(std::to_string(num_rows) + " of " + FormatCount(num_all, "trial") +
                          "; export/trials.csv has all of them.");
  }
  return Element("div", {{"class", "screen"}},
                 html + table.ToHtml() + DrawExplanations(data, failures)) +
         Element("p", {{"class", "print"}},
                 FormatCount(num_all, "trial") + " failed; export/trials.csv names them.");
}

}  // namespace

Section failures_section() { return {"failures", "Trials that failed", DrawFailedTrials}; }

}  // namespace graspbench
