#include <algorithm>

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
  const bool is_felt =
      std::any_of(grips.begin(), grips.end(), [](const GripSummary& grip) { return grip.is_felt; });
  Table table("Regulated grips of each condition: medians of the trials that reached the hold.",
              {"Condition",
               {"Trials", "that reached the hold"},
               {"Asked [N]", "sum over the hand"},
               {"Held [N]", is_felt ? "sum over the hand as it estimates it, mean of the hold"
                                    : "sum over the hand, mean of the hold"},
               {"In truth [N]", "the true sum"},
               {"Within 20 %", "trials whose held sum is"},
               {"Digits without their force",
                "more than a fifth off, with the reason and in how many of these trials"}});
  int num_held = 0;
  int num_within = 0;
  std::string off;  // conditions whose grips are mostly not what was asked for
  for (const GripSummary& grip : grips) {
    num_held += grip.held.n;
    num_within += grip.num_within;
    if (2 * grip.num_within < grip.held.n) {
      off += (off.empty() ? "" : "; ") + NameOfCell(*grip.cell, data.models);
    }
    const std::string faults = DescribeFaults(grip.faults);
    table.AddRow({LinkTo(grip.cell->key, NameOfCell(*grip.cell, data.models)), grip.held.n,
                  FormatGripMedian(grip.asked), FormatGripMedian(grip.held),
                  FormatGripMedian(grip.pressed), grip.num_within, faults.empty() ? "-" : faults});
  }
  return MakeParagraph(
             "A hand that regulates its grip closes until each digit has its share, then keeps "
             "the sum. \"Posture ends\": the digit is closed as far as it goes; \"limit\": one of "
             "its drives gives all it can; \"joint stop\", \"coupling\": a driven or a coupled "
             "joint is at its stop; \"balance\": statics give the force to others; \"no touch\", "
             "\"not felt\": it never touched, or neither its elements nor its drives' torques say "
             "what it "
             "presses with." +
             std::string(is_felt ? " Forces here are those that the hand estimates from elements "
                                   "and drive torques; elsewhere on this page forces are the true "
                                   "ones."
                                 : "")) +
         MakeParagraph("The sum is within 20 % of what was asked in " + std::to_string(num_within) +
                       " of " + FormatCount(num_held, "trial") + " that reached the hold" +
                       (off.empty() ? "." : "; in fewer than half of them with: " + off + ".")) +
         MakeDetails("Grips of all conditions", table.ToHtml());
}

}  // namespace

Section grip_section() { return {"grip", "What the grip was asked for and had", DrawGrip}; }

}  // namespace graspbench
