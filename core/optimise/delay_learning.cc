#include "core/optimise/delay_learning.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/gft_floor.h"

namespace graspbench {

std::map<std::string, ClosingSchedule> LearnDelays(const Grasp& grasp,
                                                   const std::vector<LearningTrial>& trials,
                                                   double gain) {
  const std::vector<double> medians = CalcMedianTimes(ListContacts(trials));
  double latest = -HUGE_VAL, least = HUGE_VAL;
  for (const double median : medians) {
    if (!std::isnan(median)) latest = std::max(latest, median);
  }
  std::map<std::string, ClosingSchedule> closing;
  for (size_t d = 0; d < grasp.digits.size(); ++d) {
    const auto own = grasp.closing.find(grasp.digits[d]);
    ClosingSchedule schedule = own == grasp.closing.end() ? ClosingSchedule() : own->second;
    const double median = d < medians.size() ? medians[d] : kUnset;
    if (!std::isnan(median)) schedule.delay += gain * (latest - median);
    least = std::min(least, schedule.delay);
    closing[grasp.digits[d]] = schedule;
  }
  for (auto it = closing.begin(); it != closing.end();) {
    it->second.delay -= least;
    it = it->second == ClosingSchedule() ? closing.erase(it) : std::next(it);
  }
  return closing;
}

std::string DescribeDelays(const Grasp& grasp) {
  std::string text;
  for (const std::string& digit : grasp.digits) {
    const auto own = grasp.closing.find(digit);
    if (own == grasp.closing.end() || own->second.delay <= 0.0) continue;
    text += (text.empty() ? digit + " waits " : ", " + digit + " ") +
            FormatFixed(MsFromS(own->second.delay), 0) + " ms";
  }
  return text;
}

}  // namespace graspbench
