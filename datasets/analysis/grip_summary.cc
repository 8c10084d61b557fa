#include "datasets/analysis/grip_summary.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text/csv.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "datasets/session/find_trial.h"

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

/** Median, lowest and highest of a measure; people see "12.3 (10.1 to 14.2)". */
CsvColumn<SeatSummary> MakeSpreadColumn(const char* name, const char* heading, const char* meaning,
                                        Spread SeatSummary::*member, double unit, int decimals) {
  const auto value = [member](const SeatSummary& row) {
    const Spread& spread = row.*member;
    return Json{{"n", spread.n},
                {"median", JsonNumber(spread.median)},
                {"lowest", JsonNumber(spread.lowest)},
                {"highest", JsonNumber(spread.highest)}};
  };
  return CsvColumn<SeatSummary>(name, "string", "", meaning, value)
      .Shown(heading, [=](const SeatSummary& row) {
        const Spread& spread = row.*member;
        return FormatWithRange(unit * spread.median, unit * spread.lowest, unit * spread.highest,
                               decimals);
      });
}

std::vector<CsvColumn<SeatSummary>> ListSeatColumns() {
  using Row = SeatSummary;
  using C = CsvColumn<Row>;
  return {C("hand", "", "", [](const Row& row) { return row.cell->hand; }).Shown("hand"),
          C("object", "", "", [](const Row& row) { return row.cell->object; }).Shown("object"),
          C("grasp", "", "", [](const Row& row) { return row.cell->grasp; }).Shown("grasp"),
          C("seat", "string", "", "kept, reseated, or not known",
            [](const Row& row) {
              return row.seat == Seat::kUnknown ? Json() : Json(NameOf(row.seat));
            }).Shown("seat", [](const Row& row) { return NameOf(row.seat); }),
          C("held", "", "successes in this seat", &Row::num_held).Shown("held"),
          C("caged", "", "of them", &Row::num_caged).Shown("caged"),
          MakeSpreadColumn("grip_n", "grip [N]", "mean sum of the normal forces over the hold",
                           &Row::grip, 1.0, 2),
          MakeSpreadColumn("sigma_n", "sigma [N]", "stability in the hold", &Row::sigma, 1.0, 2),
          MakeSpreadColumn("gft_s", "GFT [ms]", "grasp forming time", &Row::gft, MsFromS(1.0), 0)};
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

ShownTable ShowSeats(const std::vector<SeatSummary>& seats) {
  return ShowTable(ListSeatColumns(), seats);
}

Json ToJson(const std::vector<SeatSummary>& seats) {
  return MakeJsonRows(ListSeatColumns(), seats);
}

namespace {

constexpr double kExcess = 1.5;  // in truth over asked, by sensed touch, which is said

}  // namespace

std::vector<GripSummary> ListGrips(const SessionSummary& summary) {
  std::vector<GripSummary> grips;
  for (const CellSummary& cell : summary.cells) {
    GripSummary one;
    one.cell = &cell;
    std::vector<double> asked, held, pressed;
    std::map<std::pair<std::string, GripFault>, int> counts;
    bool is_regulated = false;
    for (const TrialRecord* record : cell.records) {
      if (!record->result.grip) continue;
      is_regulated = true;
      one.is_felt = one.is_felt || record->result.touch.has_value();
      const GripRecord& grip = *record->result.grip;
      if (std::isnan(grip.held)) continue;
      for (const DigitGripRecord& digit : grip.digits) {
        if (digit.fault != GripFault::kNone) ++counts[{digit.digit, digit.fault}];
      }
      asked.push_back(grip.asked);
      held.push_back(grip.held);
      pressed.push_back(record->result.stability.hold.normal_force);
      one.num_within += std::abs(grip.held - grip.asked) <= kGripTolerance * grip.asked;
    }
    if (!is_regulated) continue;
    one.asked = CalcSpread(asked);
    one.held = CalcSpread(held);
    one.pressed = CalcSpread(pressed);
    for (const auto& [fault, num] : counts) one.faults.push_back({fault.first, fault.second, num});
    grips.push_back(std::move(one));
  }
  return grips;
}

std::string DescribeFaults(const std::vector<GripFaultCount>& faults) {
  std::string text;
  for (const GripFaultCount& fault : faults) {
    text += (text.empty() ? "" : "; ") + fault.digit + ": " + NameOf(fault.fault) + " " +
            std::to_string(fault.num);
  }
  return text;
}

GripShortfall FindShortfall(const SessionSummary& summary) {
  GripShortfall shortfall;
  std::vector<double> asked, reached, asked_of_excess, pressed;
  std::map<GripFault, int> faults;
  for (const CellSummary& cell : summary.cells) {
    for (const TrialRecord* record : cell.records) {
      if (!record->result.grip) continue;
      const GripRecord& grip = *record->result.grip;
      const double sum = std::isnan(grip.held) ? grip.closed : grip.held;
      if (std::isnan(sum)) continue;
      ++shortfall.num_closed;
      const double force = record->result.stability.hold.normal_force;
      if (record->result.touch && force > kExcess * grip.asked) {
        asked_of_excess.push_back(grip.asked);
        pressed.push_back(force);
      }
      if (sum >= (1.0 - kGripTolerance) * grip.asked) continue;
      if (asked.empty()) shortfall.example = NameTrial(record->plan);
      asked.push_back(grip.asked);
      reached.push_back(sum);
      for (const DigitGripRecord& digit : grip.digits) {
        if (digit.fault != GripFault::kNone) ++faults[digit.fault];
      }
    }
  }
  shortfall.num = static_cast<int>(asked.size());
  shortfall.asked = CalcSpread(asked);
  shortfall.reached = CalcSpread(reached);
  shortfall.asked_of_excess = CalcSpread(asked_of_excess);
  shortfall.pressed = CalcSpread(pressed);
  int most = 0;
  for (const auto& [fault, num] : faults) {
    if (num <= most) continue;
    most = num;
    shortfall.reason = NameOf(fault);
  }
  return shortfall;
}

std::string DescribeExcess(const GripShortfall& shortfall) {
  if (shortfall.pressed.n == 0) return "";
  return fmt::format(
      "grip     {} of {} exceeded {} times the setpoint: total setpoint {} N, true total {} N "
      "(medians)",
      shortfall.pressed.n, FormatCount(shortfall.num_closed, "trial"), kExcess,
      FormatFixed(shortfall.asked_of_excess.median, 2), FormatFixed(shortfall.pressed.median, 2));
}

std::string DescribeShortfall(const GripShortfall& shortfall) {
  if (shortfall.num == 0) return "";
  return fmt::format(
      "grip     in {} of {} the total grip stayed below its setpoint: {} N instead of {} N "
      "(medians), first in {}{}",
      shortfall.num, FormatCount(shortfall.num_closed, "trial"),
      FormatFixed(shortfall.reached.median, 2), FormatFixed(shortfall.asked.median, 2),
      shortfall.example,
      shortfall.reason.empty() ? "" : "; most frequent reason: " + shortfall.reason);
}

}  // namespace graspbench
