#include "core/base/text/text.h"
#include "datasets/analysis/grip_summary.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

Html DrawSeats(const ReportData& data) {
  const std::vector<SeatSummary> seats = ListSeats(data.summary);
  if (seats.empty()) return MakeParagraph("No grasp was held.");
  const std::string counts = DescribeSeats(seats);
  const std::string intro =
      "An object may sit where the digits met it (kept), or be squeezed up between them before it "
      "is lifted (reseated): by more than 43 % of its height, sliding through all that touch it. "
      "Caged is a success that holds with less than 1.5 N or five weights. Figures of two seats "
      "are not averaged. ";
  std::vector<Html> names;
  for (const SeatSummary& seat : seats) {
    names.push_back(LinkTo(seat.cell->key, data.models.NameOfHand(seat.cell->hand)));
  }
  return MakeParagraph(
             intro + (counts.empty() ? "These records tell no seats." : Capitalise(counts) + ".")) +
         MakeDetails("Seats of all conditions",
                     MakeTable("Held grasps by condition and seat: medians, lowest to highest.",
                               ShowSeats(seats), names));
}

}  // namespace

Section seats_section() { return {"seats", "Where objects sit in the hand", DrawSeats}; }

}  // namespace graspbench
