#include "core/base/text/text.h"
#include "reports/outcome_words.h"
#include "reports/page/layout.h"
#include "reports/plots/svg_plot.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

StackedBars::Row MakeRow(const std::string& label, const std::string& anchor, const Tally& tally) {
  return {label, anchor, {tally.outcomes.begin(), tally.outcomes.end()}};
}

Html DrawHand(const std::string& hand, const ReportData& data) {
  const std::string name = data.models.NameOfHand(hand);
  StackedBars plot;
  plot.text.title = "Outcomes with the " + name;
  plot.text.description =
      "One bar per condition with a failure, divided by outcome; the same counts stand in the "
      "table of all conditions.";
  for (Outcome outcome : ListOutcomes())
    plot.classes.push_back({WordsOf(outcome), CodeOf(outcome)});
  plot.rows.push_back(MakeRow("all objects", {}, data.summary.TallyOf(hand)));
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
  const std::string left_out = num_without == 0
                                   ? ""
                                   : " Not drawn: " + FormatCount(num_without, "condition") +
                                         " in which every finished trial succeeded.";
  return MakeFigure("Outcomes of all finished trials with the " + name + "." + left_out,
                    "one class of failure over many objects (the strategy's fault) against "
                    "one object failing in many ways (the object's).",
                    MakeScroll(plot.text.title, DrawStackedBars(plot)));
}

Html DrawOutcomeClasses(const ReportData& data) {
  if (data.summary.cells.empty()) return MakeParagraph("There is nothing to show.");
  Html html;
  for (const std::string& hand : data.summary.hands) html += DrawHand(hand, data);
  return html;
}

}  // namespace

Section outcome_classes_section() { return {"outcomes", "How trials ended", DrawOutcomeClasses}; }

}  // namespace graspbench
