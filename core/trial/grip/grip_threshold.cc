#include "core/trial/grip/grip_threshold.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace graspbench {

GripThreshold FindGripThreshold(const ThresholdRange& range,
                                const std::function<bool(double grip)>& succeeds) {
  GRASPBENCH_DEMAND(range.least > 0.0 && range.most > range.least, std::to_string(range.most));
  GripThreshold found;
  const auto ask = [&](double grip) {
    const bool has_succeeded = succeeds(grip);
    (has_succeeded ? found.succeeded : found.failed).push_back(grip);
    return has_succeeded;
  };
  if (!ask(range.most)) return found;
  double lower = range.least, upper = range.most;
  bool is_lower_asked = false;
  for (int asked = 1; asked < kMostThresholdTrials - 1; ++asked) {
    const double middle = std::sqrt(lower * upper);
    if (ask(middle)) {
      upper = middle;
    } else {
      lower = middle;
      is_lower_asked = true;
    }
  }
  if (!is_lower_asked && ask(range.least)) {
    found.value = range.least;
    found.is_below_range = true;
    return found;
  }
  found.value = upper;
  if (is_lower_asked && upper < range.most) {
    found.is_monotone = ask(std::sqrt(upper * range.most));
  }
  return found;
}

}  // namespace graspbench
