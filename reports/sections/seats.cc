#include "core/base/text/text.h"
#include "core/base/units.h"
#include "datasets/analysis/seat_summary.h"
#include "reports/outcome_words.h"
#include "reports/page/layout.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

Html FormatSpread(const Spread& spread, double unit, int decimals) {
  if (spread.n == 0) return Text("n/a");
  const auto format = [&](double value) { return FormatFixed(unit * value, decimals); };
  return Text(format(spread.median) + " (" + format(spread.lowest) + " to " +
              format(spread.highest) + ")");
}

Html DrawSeats(const ReportData& data) {
  const std::vector<SeatSummary> seats = ListSeats(data.summary);
  if (seats.empty()) return MakeParagraph("No grasp was held.");
  const std::string counts = DescribeSeats(seats);
  const std::string intro =
      "An object may sit where the digits met it (kept), or be squeezed up between them before it "
      "is lifted (reseated): by more than 43 % of its height, sliding through all that touch it. "
      "Caged is a success that holds with less than 1.5 N or five weights. Figures of two seats "
      "are not averaged. ";
  const Align number = Align::kNumber;
  Table table("Held grasps by condition and seat: medians, lowest to highest.",
              {{"Condition"},
               {"Seat"},
               {"Held", number, "successes that sit so"},
               {"Caged", number},
               {"Grip [N]", number, "mean sum of the normal forces over the hold"},
               {"sigma [N]", number, "stability in the hold"},
               {"GFT [ms]", number, "grasp forming time"}});
  for (const SeatSummary& seat : seats) {
    table.AddRow({LinkTo(seat.cell->key, NameOfCell(*seat.cell, data.models)),
                  Text(WordsOf(seat.seat)), Text(std::to_string(seat.num_held)),
                  Text(std::to_string(seat.num_caged)), FormatSpread(seat.grip, 1.0, 2),
                  FormatSpread(seat.sigma, 1.0, 2), FormatSpread(seat.gft, MsFromS(1.0), 0)});
  }
  return MakeParagraph(
             intro + (counts.empty() ? "These records tell no seats." : Capitalise(counts) + ".")) +
         MakeDetails("Seats of all conditions", table.ToHtml());
}

}  // namespace

Section seats_section() { return {"seats", "Where objects sit in the hand", DrawSeats}; }

}  // namespace graspbench
