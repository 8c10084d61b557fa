#include "datasets/analysis/seat_summary.h"

#include <algorithm>

#include "core/base/text/text.h"

namespace graspbench {
namespace {

SeatSummary SummariseSeat(const CellSummary& cell, Seat seat) {
  SeatSummary summary;
  summary.cell = &cell;
  summary.seat = seat;
  std::vector<double> grip, sigma, gft;
  for (const TrialRecord* record : cell.records) {
    const TrialResult& result = record->result;
    if (!IsSuccess(result.outcome) || FindSeat(result) != seat) continue;
    ++summary.num_held;
    summary.num_caged += IsCaged(result);
    grip.push_back(result.stability.hold.normal_force);
    sigma.push_back(result.stability.sigma);
    if (!result.timing.contact_before_start) gft.push_back(result.timing.gft);
  }
  summary.grip = CalcSpread(grip);
  summary.sigma = CalcSpread(sigma);
  summary.gft = CalcSpread(gft);
  return summary;
}

Json MakeSpreadJson(const Spread& spread) {
  return {{"n", spread.n},
          {"median", JsonNumber(spread.median)},
          {"lowest", JsonNumber(spread.lowest)},
          {"highest", JsonNumber(spread.highest)}};
}

}  // namespace

std::vector<SeatSummary> ListSeats(const SessionSummary& summary) {
  std::vector<SeatSummary> seats;
  for (const CellSummary& cell : summary.cells) {
    for (const Seat seat : kSeats) {
      const SeatSummary one = SummariseSeat(cell, seat);
      if (one.num_held > 0) seats.push_back(one);
    }
  }
  return seats;
}

std::string DescribeSeats(const std::vector<SeatSummary>& seats) {
  int num_held = 0, num_reseated = 0, num_caged = 0, num_double = 0;
  for (size_t i = 0; i < seats.size(); ++i) {
    if (seats[i].seat == Seat::kUnknown) continue;
    num_held += seats[i].num_held;
    num_caged += seats[i].num_caged;
    if (seats[i].seat != Seat::kReseated) continue;
    num_reseated += seats[i].num_held;
    num_double += i > 0 && seats[i - 1].cell == seats[i].cell;
  }
  if (num_held == 0) return "";
  return "of " + FormatCount(num_held, "held grasp") + " " + std::to_string(num_reseated) +
         (num_reseated == 1 ? " is" : " are") + " reseated, " + std::to_string(num_caged) +
         (num_caged == 1 ? " is" : " are") + " caged; " +
         FormatCount(num_double, "condition has", "conditions have") + " two seats";
}

Json ToJson(const std::vector<SeatSummary>& seats) {
  Json list = Json::array();
  for (const SeatSummary& seat : seats) {
    list.push_back({{"hand", seat.cell->hand},
                    {"object", seat.cell->object},
                    {"grasp", seat.cell->grasp},
                    {"seat", seat.seat == Seat::kUnknown ? Json() : Json(NameOf(seat.seat))},
                    {"held", seat.num_held},
                    {"caged", seat.num_caged},
                    {"grip_n", MakeSpreadJson(seat.grip)},
                    {"sigma_n", MakeSpreadJson(seat.sigma)},
                    {"gft_s", MakeSpreadJson(seat.gft)}});
  }
  return list;
}

}  // namespace graspbench
