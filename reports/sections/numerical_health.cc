#include "core/base/text/text.h"
#include "core/base/units.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

Html DrawTotals(const ReportData& data) {
  Table table("Numerical health by hand, over all finished trials.",
              {"Hand",
               {"n", "finished trials"},
               "Numerical failures",
               {"Worst penetration [mm]", "deepest finger contact of any trial"},
               {"Largest energy residual [mJ]", "unexplained energy of a whole trial"},
               "Steps",
               {"Steps not converged", "steps whose solve missed its tolerance"},
               {"Share [%]", "of steps not converged"}});
  for (const std::string& hand : data.summary.hands) {
    const Tally tally = data.summary.TallyOf(hand);
    table.AddRow({data.models.NameOfHand(hand), tally.finished,
                  tally.CountOf(Outcome::kNumericalFailure),
                  FormatFixed(MmFromM(tally.worst_penetration), 2),
                  FormatSignificant(MjFromJ(tally.worst_energy_residual), 3), tally.num_steps,
                  tally.num_unconverged, FormatFixed(100.0 * tally.share_unconverged(), 3)});
  }
  return table.ToHtml();
}

Html DrawFailures(const ReportData& data) {
  constexpr int kMaxListed = 200;
  int num_listed = 0;
  Table table("Numerical failures.", {"Condition", "Trial", "Trial id", "Reason"});
  for (const CellSummary& cell : data.summary.cells) {
    for (const TrialRecord* record : cell.records) {
      if (record->result.outcome != Outcome::kNumericalFailure) continue;
      if (++num_listed > kMaxListed) {
        return table.ToHtml() + MakeParagraph("The first " + std::to_string(kMaxListed) +
                                              "; export/trials.csv has all of them.");
      }
      table.AddRow({LinkTo(cell.key, NameOfCell(cell, data.models)), record->plan.trial,
                    Element("code", {}, record->plan.id), record->result.reason});
    }
  }
  return table.ToHtml();
}

/** Shows how the time step and other numerical settings change the session's results. */
Html DrawNumerics(const std::vector<NumericsSummary>& numerics) {
  if (numerics.empty()) return Html();
  return MakeTable("Trials repeated with other numerical settings.", ShowVariants(numerics)) +
         MakeTable("Median (and largest) relative change of trials held in the same seat.",
                   ShowSeatChanges(numerics));
}

Html DrawNumericalHealth(const ReportData& data) {
  Html html = MakeParagraph(
      "What to look for: penetration well below the size of a fingertip, an energy residual well "
      "below the work of lifting (0.1 J for 100 g through 0.1 m), and few unconverged steps.");
  html += DrawTotals(data) + DrawNumerics(data.numerics);
  if (data.summary.total.CountOf(Outcome::kNumericalFailure) == 0) {
    return html + MakeParagraph("No trial failed numerically.");
  }
  return html + DrawFailures(data);
}

}  // namespace

Section numerical_health_section() { return {"health", "Numerical health", DrawNumericalHealth}; }

}  // namespace graspbench
