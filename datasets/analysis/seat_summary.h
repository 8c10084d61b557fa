#pragma once
/** @file
What held grasps of a condition are like, seat by seat (core/trial/measures/seat.h): grip force,
sigma and GFT of two seats of one object differ by several times, so that a figure over both would
describe neither. */

#include <vector>

#include "core/base/text/json.h"
#include "core/trial/measures/seat.h"
#include "datasets/analysis/session_summary.h"

namespace graspbench {

/** Successes of one cell that sit alike. */
struct SeatSummary {
  const CellSummary* cell = nullptr;
  Seat seat = Seat::kUnknown;
  int num_held = 0;
  int num_caged = 0;
  Spread grip;   ///< mean sum of the normal forces over the hold [N]
  Spread sigma;  ///< [N]
  Spread gft;    ///< without trials with a contact before the start of closure [s]
};

/** Cells in their order, of each the seats that occur: kept, reseated, unknown (records of older
physics). Cells without a success have none. The result points into `summary`. */
std::vector<SeatSummary> ListSeats(const SessionSummary& summary);

/** "12 of 420 held grasps are reseated, 1 is caged; 5 conditions have two seats"; empty where no
seat is known. */
std::string DescribeSeats(const std::vector<SeatSummary>& seats);

/** One object each. */
Json ToJson(const std::vector<SeatSummary>& seats);

}  // namespace graspbench
