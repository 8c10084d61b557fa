#include "core/base/text/text.h"
#include "datasets/analysis/grip_summary.h"
#include "reports/page/layout.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

std::string FormatGripMedian(const Spread& spread) {
  return spread.n == 0 ? "n/a" : FormatFixed(spread.median, 2);
}

Html DrawGrip(const ReportData& data) {
  const std::vector<GripSummary> grips = ListGrips(data.summary);
  if (grips.empty()) {
    return MakeParagraph(
        "These trials close to their target posture: the grip is what posture and stiffness "
        "give.");
  }
  const Align number = Align::kNumber;
  Table table("Regulated grips of each cell: medians of the trials that reached the hold.",
              {{"Cell"},
               {"Trials", number, "that reached the hold"},
               {"Asked [N]", number, "sum over the hand"},
               {"Held [N]", number, "sum over the hand, mean of the hold"},
               {"Within 20 %", number, "trials whose held sum is"},
               {"Digits without their force", Align::kText,
                "more than a fifth off, with the reason and in how many finished trials"}});
  for (const GripSummary& grip : grips) {
    const std::string faults = DescribeFaults(grip.faults);
    table.AddRow({LinkTo(grip.cell->key, NameOfCell(*grip.cell, data.models)),
                  Text(std::to_string(grip.held.n)), Text(FormatGripMedian(grip.asked)),
                  Text(FormatGripMedian(grip.held)), Text(std::to_string(grip.num_within)),
                  Text(faults.empty() ? "-" : faults)});
  }
  return MakeParagraph(
             "A hand that regulates its grip closes until each digit has its share, then keeps "
             "the sum. \"Posture ends\": the digit is closed as far as it goes; \"limit\": one of "
             "its drives gives all it can; \"coupling\": a coupled joint is at its stop; "
             "\"balance\": statics give the force to others; \"no touch\", \"not felt\": it never "
             "touched, or has nothing to feel by.") +
         table.ToHtml();
}

}  // namespace

Section grip_section() { return {"grip", "What the grip was asked for and had", DrawGrip}; }

}  // namespace graspbench
