#pragma once
/** @file
How regulated grips of each condition came out: what was asked and held in sum, and which digits
differ from what was asked of them by more than kGripTolerance, for which reason. */

#include <string>
#include <vector>

#include "core/base/text/csv.h"
#include "core/base/text/json.h"
#include "core/trial/measures/object_in_hand.h"
#include "datasets/analysis/session_summary.h"

namespace graspbench {

/** A digit that did not have its force for this reason, in so many trials that reached the hold. */
struct GripFaultCount {
  std::string digit;
  GripFault fault = GripFault::kNone;
  int num = 0;
};

struct GripSummary {
  const CellSummary* cell = nullptr;
  Spread asked, held;    ///< sums over the hand, of the trials that reached the hold [N]
  Spread pressed;        ///< the true sum of these trials, felt or not [N]
  int num_within = 0;    ///< of them, whose sum is within kGripTolerance
  bool is_felt = false;  ///< by sensed touch: held is what the hand estimates
  std::vector<GripFaultCount> faults;  ///< by digit, then by reason
};

/** Cells in their order, of those that regulate their grip. The result points into `summary`. */
std::vector<GripSummary> ListGrips(const SessionSummary& summary);

/** "FF: limit 3; TH: balance 1"; empty: every digit had its force. */
std::string DescribeFaults(const std::vector<GripFaultCount>& faults);

/** Trials whose sum stayed more than kGripTolerance below what was asked: in the hold, or before
lift-off where there was no hold. */
struct GripShortfall {
  int num = 0, num_closed = 0;      ///< of those whose grip had closed
  Spread asked, reached;            ///< of these trials [N]
  std::string reason;               ///< most frequent of their digits; empty: none is known
  Spread asked_of_excess, pressed;  ///< by sensed touch, above 1.5 times asked [N]
};
GripShortfall FindShortfall(const SessionSummary& summary);

/** "grip     3 of 4 trials did not reach what was asked: ..."; empty where all did. */
std::string DescribeShortfall(const GripShortfall& shortfall);

/** "grip     2 of 4 trials pressed more than 1.5 times as hard as asked: ..."; empty: none did. */
std::string DescribeExcess(const GripShortfall& shortfall);

/* What held grasps of a condition are like, seat by seat (object_in_hand.h): grip force,
sigma and GFT of two seats of one object differ by several times, so that a figure over both would
describe neither. */

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

/** Medians, lowest to highest. */
ShownTable ShowSeats(const std::vector<SeatSummary>& seats);

/** One object each. */
Json ToJson(const std::vector<SeatSummary>& seats);

}  // namespace graspbench
