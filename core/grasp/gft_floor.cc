#include "core/grasp/gft_floor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/error.h"
#include "core/statistics/summary.h"

namespace graspbench {

std::vector<double> CalcMedianTimes(const std::vector<std::vector<DigitContact>>& trials) {
  std::vector<double> medians;
  for (size_t digit = 0;; ++digit) {
    bool is_digit = false;
    std::vector<double> times;
    for (const std::vector<DigitContact>& contacts : trials) {
      if (digit >= contacts.size()) continue;
      is_digit = true;
      if (!std::isnan(contacts[digit].time)) times.push_back(contacts[digit].time);
    }
    if (!is_digit) return medians;
    medians.push_back(CalcMedian(times));
  }
}

Answer<double> CalcGftFloor(const std::vector<std::vector<DigitContact>>& trials, double t0) {
  const std::vector<double> medians = CalcMedianTimes(trials);
  double latest = -std::numeric_limits<double>::infinity();
  int num_touching = 0, num_complete = 0;
  for (const double median : medians) {
    if (std::isnan(median)) continue;
    latest = std::max(latest, median);
    ++num_touching;
  }
  if (num_touching < 2) return NoAnswer{"fewer than two digits touched"};
  std::vector<double> ratios;
  for (std::vector<DigitContact> contacts : trials) {
    GRASPBENCH_DEMAND(contacts.empty() || contacts.size() == medians.size(),
                      std::to_string(contacts.size()));
    for (size_t i = 0; i < contacts.size(); ++i) contacts[i].time += latest - medians[i];
    const double ratio = CalcContactTiming(contacts, t0).gft_ratio;
    num_complete += std::isnan(ratio) ? 0 : 1;
    ratios.push_back(std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio);
  }
  if (num_complete < kLeastTrialsOfFloor) {
    return NoAnswer{"all digits touched in " + std::to_string(num_complete) +
                    " of the trials; expected " + std::to_string(kLeastTrialsOfFloor) + " or more"};
  }
  const double floor = CalcMedian(ratios);
  if (std::isinf(floor)) return NoAnswer{"a digit did not touch in half of the trials or more"};
  return floor;
}

}  // namespace graspbench
