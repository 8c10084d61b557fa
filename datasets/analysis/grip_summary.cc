#include "datasets/analysis/grip_summary.h"

#include <fmt/core.h>

#include <cmath>
#include <map>

#include "core/base/text/text.h"

namespace graspbench {
namespace {

constexpr double kExcess = 2.0;  // in truth over asked, by sensed touch, which is said

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
      "grip     {} of {} pressed more than twice as hard as asked, beside what feels: "
      "asked {} N, in truth {} N (sums, medians)",
      shortfall.pressed.n, FormatCount(shortfall.num_closed, "trial"),
      FormatFixed(shortfall.asked_of_excess.median, 2), FormatFixed(shortfall.pressed.median, 2));
}

std::string DescribeShortfall(const GripShortfall& shortfall) {
  if (shortfall.num == 0) return "";
  return fmt::format(
      "grip     {} of {} did not reach what was asked: asked {} N, reached {} N (sums, medians){}",
      shortfall.num, FormatCount(shortfall.num_closed, "trial"),
      FormatFixed(shortfall.asked.median, 2), FormatFixed(shortfall.reached.median, 2),
      shortfall.reason.empty() ? "" : "; mostly: " + shortfall.reason);
}

}  // namespace graspbench
