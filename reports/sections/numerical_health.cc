#include "core/base/text/text.h"
#include "core/base/units.h"
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
              {{"Cell"}, {"Trial"}, {"Trial id"}, {"Reason", Align::kProse}});
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

Html DrawNumericalHealth(const ReportData& data) {
  Html html = MakeParagraph(
      "What to look for: penetration well below the size of a fingertip, an energy residual small "
      "against the work of lifting (0.1 J for 100 g through 0.1 m), and few steps whose solve "
      "missed its tolerance.");
  html += DrawTotals(data);
  if (data.summary.total.CountOf(Outcome::kNumericalFailure) == 0) {
    return html + MakeParagraph("No trial ended as numerical failure.");
  }
  return html + DrawFailures(data);
}

}  // namespace

Section numerical_health_section() { return {"health", "Numerical health", DrawNumericalHealth}; }

}  // namespace graspbench
