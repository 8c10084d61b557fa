#pragma once
/** @file
How well the grips of each cell were regulated: setpoint and measured total force, and which digits
missed their setpoint by more than kGripTolerance, with the reason. */

#include <string>
#include <vector>

#include "core/base/text/csv.h"
#include "core/base/text/json.h"
#include "core/trial/measures/object_in_hand.h"
#include "datasets/analysis/session_summary.h"

namespace graspbench {

/** Number of trials that reached the hold in which a digit missed its setpoint for this reason. */
struct GripFaultCount {
  std::string digit;
  GripFault fault = GripFault::kNone;
  int num = 0;
};

struct GripSummary {
  const CellSummary* cell = nullptr;
  Spread asked, held;    ///< total setpoint and force of the hand, in the hold [N]
  Spread pressed;        ///< true total force in the hold, whether sensed or not [N]
  int num_within = 0;    ///< trials whose total is within kGripTolerance of the setpoint
  bool is_felt = false;  ///< under sensed touch, `held` is the hand's estimate
  std::vector<GripFaultCount> faults;  ///< by digit, then by reason
};

/** Lists the cells with a regulated grip, in their order. The result points into `summary`. */
std::vector<GripSummary> ListGrips(const SessionSummary& summary);

/** Returns "FF: limit 3; TH: balance 1"; empty if every digit had its force. */
std::string DescribeFaults(const std::vector<GripFaultCount>& faults);

/** Trials whose total force stayed more than kGripTolerance below the setpoint, in the hold, or
before lift-off where there was no hold. */
struct GripShortfall {
  int num = 0, num_closed = 0;      ///< of the trials whose grip had closed
  Spread asked, reached;            ///< setpoint and force of these trials [N]
  std::string reason;               ///< most frequent reason of their digits; empty: unknown
  std::string example;              ///< name of the first of these trials
  Spread asked_of_excess, pressed;  ///< under sensed touch, above 1.5 times the setpoint [N]
};
GripShortfall FindShortfall(const SessionSummary& summary);

/** "grip     3 of 4 trials did not reach what was asked: ..."; empty where all did. */
std::string DescribeShortfall(const GripShortfall& shortfall);

/** "grip     2 of 4 trials pressed more than 1.5 times as hard as asked: ..."; empty: none did. */
std::string DescribeExcess(const GripShortfall& shortfall);

/* Held grasps of a cell by seat (object_in_hand.h): grip force, sigma and GFT of two seats of one
object differ by a factor of several, so that a figure over both would describe neither. */

/** Successes of one cell with the same seat. */
struct SeatSummary {
  const CellSummary* cell = nullptr;
  Seat seat = Seat::kUnknown;
  int num_held = 0;
  int num_caged = 0;
  Spread grip;   ///< mean sum of the normal forces over the hold [N]
  Spread sigma;  ///< [N]
  Spread gft;    ///< excludes trials with a contact before the start of closure [s]
};

/** Lists the seats that occur in each cell, in the order of cells: kept, reseated, unknown (records
of older physics). Cells without a success have none. The result points into `summary`. */
std::vector<SeatSummary> ListSeats(const SessionSummary& summary);

/** Returns "12 of 420 held grasps are reseated, 1 is caged; 5 conditions have two seats"; empty if
no seat is known. */
std::string DescribeSeats(const std::vector<SeatSummary>& seats);

/** Shows medians and ranges. */
ShownTable ShowSeats(const std::vector<SeatSummary>& seats);

/** Writes one JSON object per seat. */
Json ToJson(const std::vector<SeatSummary>& seats);

}  // namespace graspbench
