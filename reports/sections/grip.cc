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
        "These trials close to the target posture; posture and stiffness determine the grip "
        "force.");
  }
  const bool is_felt =
      std::any_of(grips.begin(), grips.end(), [](const GripSummary& grip) { return grip.is_felt; });
  Table table("Regulated grip force by condition: medians over the trials that reached the hold.",
              {"Condition",
               {"Trials", "that reached the hold"},
               {"Setpoint [N]", "total over the hand"},
               {"Hold [N]", is_felt ? "total estimated by the hand, mean of the hold"
                                    : "total, mean of the hold"},
               {"True hold [N]", "true total, mean of the hold"},
               {"Within 20 %", "trials whose total is within 20 % of the setpoint"},
               {"Digits off their setpoint",
                "deviation above 20 %, with the reason and the number of trials"}});
  int num_held = 0;
  int num_within = 0;
  std::string off;  // conditions in which most grips missed the setpoint
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
             "A regulated hand closes until each digit reaches its setpoint, then controls the "
             "total force. Reasons for a deviation: \"posture ends\", the digit is fully closed; "
             "\"limit\", a drive is at its limit; \"joint stop\" or \"coupling\", a driven or "
             "coupled joint is at its stop; \"balance\", the setpoints of the digits cannot "
             "balance "
             "each other at these contact points; \"no touch\", the digit never touched; \"not "
             "felt\", neither tactile "
             "elements nor drive torques measure its force." +
             std::string(is_felt ? " Forces in this section are the hand's estimates from tactile "
                                   "elements and drive torques; other sections give true forces."
                                 : "")) +
         MakeParagraph("The total is within 20 % of the setpoint in " + std::to_string(num_within) +
                       " of " + FormatCount(num_held, "trial") + " that reached the hold" +
                       (off.empty() ? "." : "; conditions with fewer than half: " + off + ".")) +
         MakeDetails("Grip force of all conditions", table.ToHtml());
}

}  // namespace

Section grip_section() { return {"grip", "Grip force: setpoint and measured", DrawGrip}; }

}  // namespace graspbench
