#include "core/base/text/text.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/plots/svg_plot.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

StackedBars::Row MakeRow(const std::string& label, const std::string& anchor, const Tally& tally) {
  return {label, anchor, {tally.outcomes.begin(), tally.outcomes.end()}, false};
}

/** Adds a row for the hand, then one for each of its conditions with a failure. @returns the number
of conditions left out */
int AddHand(const std::string& hand, const ReportData& data, StackedBars& plot) {
  plot.rows.push_back(MakeRow(data.models.NameOfHand(hand), {}, data.summary.TallyOf(hand)));
  plot.rows.back().is_total = true;
  int num_without = 0;
  for (const CellSummary& cell : data.summary.cells) {
    if (cell.hand != hand) continue;
    if (cell.tally.is_faultless()) {
      ++num_without;
      continue;
    }
    plot.rows.push_back(
        MakeRow(data.models.NameOfObject(cell.object) + " " + cell.grasp, cell.key, cell.tally));
  }
  return num_without;
}

Html DrawOutcomeClasses(const ReportData& data) {
  if (data.summary.cells.empty()) return MakeParagraph("There is nothing to show.");
  StackedBars plot;
  plot.text.title = "Outcomes";
  plot.text.description =
      "One bar per hand and one per condition with a failure, divided by outcome; the table of all "
      "conditions has the counts.";
  for (Outcome outcome : ListOutcomes())
    plot.classes.push_back({WordsOf(outcome), CodeOf(outcome)});
  int num_without = 0;
  for (const std::string& hand : data.summary.hands) num_without += AddHand(hand, data, plot);
  const std::string left_out = num_without == 0
                                   ? ""
                                   : " Not drawn: " + FormatCount(num_without, "condition") +
                                         " in which every finished trial succeeded.";
  return MakeFigure("Outcomes of all finished trials, by hand and condition." + left_out,
                    "one failure class over many objects (cause: strategy) or many failure classes "
                    "on one object (cause: object).",
                    MakeScroll(plot.text.title, DrawStackedBars(plot)));
}

}  // namespace

Section outcome_classes_section() { return {"outcomes", "How trials ended", DrawOutcomeClasses}; }

}  // namespace graspbench
