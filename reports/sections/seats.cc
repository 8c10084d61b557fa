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
      "The object either keeps its position in the hand before lift-off (kept) or is squeezed "
      "upwards by more than 43 % of its height while sliding along all contacts (reseated). A "
      "success is caged if the total grip is below 1.5 N or five object weights. Values of "
      "different seats are never averaged. ";
  std::vector<Html> names;
  for (const SeatSummary& seat : seats) {
    names.push_back(LinkTo(seat.cell->key, data.models.NameOfHand(seat.cell->hand)));
  }
  return MakeParagraph(intro + (counts.empty() ? "These records contain no seats."
                                               : Capitalise(counts) + ".")) +
         MakeDetails("Seats of all conditions",
                     MakeTable("Held grasps by condition and seat: medians, lowest to highest.",
                               ShowSeats(seats), names));
}

}  // namespace

Section seats_section() {
  return {"seats", "Object position in the hand (in-grasp shift, enclosure)", DrawSeats};
}

}  // namespace graspbench
