#include "core/base/text/range_text.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "reports/outcome_words.h"
#include "reports/page/layout.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

Html DrawTotals(const ReportData& data) {
  const Align number = Align::kNumber;
  Table table("Numerical health by hand, over all finished trials.",
              {{"Hand"},
               {"n", number, "finished trials"},
               {"Numerical failures", number},
               {"Worst penetration [mm]", number, "deepest finger contact of any trial"},
               {"Largest energy residual [mJ]", number, "unexplained energy of a whole trial"},
               {"Steps", number},
               {"Steps not converged", number, "solves that did not reach their tolerance"},
               {"Share [%]", number, "of steps not converged"}});
  for (const std::string& hand : data.summary.hands) {
    const Tally tally = data.summary.TallyOf(hand);
    table.AddRow({Text(data.models.NameOfHand(hand)), Text(std::to_string(tally.finished)),
                  Text(std::to_string(tally.CountOf(Outcome::kNumericalFailure))),
                  Text(FormatFixed(MmFromM(tally.worst_penetration), 2)),
                  Text(FormatSignificant(MjFromJ(tally.worst_energy_residual), 3)),
                  Text(std::to_string(tally.num_steps)),
                  Text(std::to_string(tally.num_unconverged)),
                  Text(FormatFixed(100.0 * tally.share_unconverged(), 3))});
  }
  return table.ToHtml();
}

Html DrawFailures(const ReportData& data) {
  constexpr int kMaxListed = 200;
  int num_listed = 0;
  Table table("Trials that ended as numerical failure.",
              {{"Condition"}, {"Trial"}, {"Trial id"}, {"Reason", Align::kProse}});
  for (const CellSummary& cell : data.summary.cells) {
    for (const TrialRecord* record : cell.records) {
      if (record->result.outcome != Outcome::kNumericalFailure) continue;
      if (++num_listed > kMaxListed) {
        return table.ToHtml() + MakeParagraph("The first " + std::to_string(kMaxListed) +
                                              "; export/trials.csv has all of them.");
      }
      table.AddRow({LinkTo(cell.key, NameOfCell(cell, data.models)),
                    Text(std::to_string(record->plan.trial)), Element("code", {}, record->plan.id),
                    Text(record->result.reason)});
    }
  }
  return table.ToHtml();
}

Html FormatChange(const ChangeSummary& change) {
  if (change.num == 0) return Text("n/a");
  return Text(FormatSignificant(100.0 * change.median, 2) + " (" +
              FormatSignificant(100.0 * change.max, 2) + ")");
}

/** What the step and its like make of the session's numbers. */
Html DrawNumerics(const std::vector<NumericsSummary>& numerics) {
  if (numerics.empty()) {
    return Element("p", {},
                   Text("Not checked: how far these numbers depend on the step. ") +
                       Element("code", {}, "graspbench check-numerics") +
                       Text(" with the session's folder repeats trials at other steps and "
                            "stiffnesses and adds what it finds here."));
  }
  const Align number = Align::kNumber;
  Table counts("Trials repeated under other numerics.",
               {{"Variant"},
                {"Trials", number,
                 "n of N: the others are not finished, or the variant's backend cannot move them"},
                {"Verdict flips", number, "a success becomes a failure, or the reverse"},
                {"Held", number, "before and after"},
                {"Seat flips", number, "of them"},
                {"Flagged", number, "of them: reseated or caged in this session"},
                {"Others above 10 %", number,
                 "of the others: grip, sigma or breaking force changes by more"}});
  std::vector<Column> columns = {{"Variant"}, {"Seat"}, {"Held", number}};
  for (const NumericsMeasure& measure : ListNumericsMeasures()) {
    columns.push_back({measure.title + std::string(" [%]"), number, {}});
  }
  Table changes("Median (and largest) relative change of trials held in the same seat.", columns);
  for (const NumericsSummary& summary : numerics) {
    counts.AddRow(
        {Text(summary.variant),
         Text(FormatCountOf(summary.num_trials, summary.num_trials + summary.num_left_out)),
         Text(std::to_string(summary.num_flips)), Text(std::to_string(summary.num_held)),
         Text(std::to_string(summary.num_seat_flips)), Text(std::to_string(summary.num_flagged)),
         Text(std::to_string(summary.num_large))});
    for (const SeatNumerics& seat : summary.seats) {
      std::vector<Html> row = {Text(summary.variant), Text(WordsOf(seat.seat)),
                               Text(std::to_string(seat.num_held))};
      for (const ChangeSummary& change : seat.changes) row.push_back(FormatChange(change));
      changes.AddRow(row);
    }
  }
  return counts.ToHtml() + changes.ToHtml();
}

Html DrawNumericalHealth(const ReportData& data) {
  Html html = MakeParagraph(
      "What to look for: penetration well below the size of a fingertip, an energy residual small "
      "against the work of lifting (0.1 J for 100 g through 0.1 m), and few steps whose solve "
      "missed its tolerance.");
  html += DrawTotals(data) + DrawNumerics(data.numerics);
  if (data.summary.total.CountOf(Outcome::kNumericalFailure) == 0) {
    return html + MakeParagraph("No trial ended as numerical failure.");
  }
  return html + DrawFailures(data);
}

}  // namespace

Section numerical_health_section() { return {"health", "Numerical health", DrawNumericalHealth}; }

}  // namespace graspbench
