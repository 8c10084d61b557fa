#include "datasets/analysis/grip_summary.h"

#include <cmath>
#include <map>

namespace graspbench {

std::vector<GripSummary> ListGrips(const SessionSummary& summary) {
  std::vector<GripSummary> grips;
  for (const CellSummary& cell : summary.cells) {
    GripSummary one;
    one.cell = &cell;
    std::vector<double> asked, held;
    std::map<std::pair<std::string, GripFault>, int> counts;
    bool is_regulated = false;
    for (const TrialRecord* record : cell.records) {
      if (!record->result.grip) continue;
      is_regulated = true;
      const GripRecord& grip = *record->result.grip;
      for (const DigitGripRecord& digit : grip.digits) {
        if (digit.fault != GripFault::kNone) ++counts[{digit.digit, digit.fault}];
      }
      if (std::isnan(grip.held)) continue;
      asked.push_back(grip.asked);
      held.push_back(grip.held);
      one.num_within += std::abs(grip.held - grip.asked) <= kGripTolerance * grip.asked;
    }
    if (!is_regulated) continue;
    one.asked = CalcSpread(asked);
    one.held = CalcSpread(held);
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

}  // namespace graspbench
