#include "core/optimise/contact_times.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/statistics/summary.h"

namespace graspbench {
namespace {

double CalcGftFloorTime(const std::vector<std::vector<DigitContact>>& timed) {
  if (timed.size() < static_cast<size_t>(kLeastTrialsOfFloor)) return kUnset;
  const std::vector<double> medians = CalcMedianTimes(timed);
  const double latest = *std::max_element(medians.begin(), medians.end());
  std::vector<double> gfts;
  for (std::vector<DigitContact> contacts : timed) {
    for (size_t i = 0; i < contacts.size(); ++i) contacts[i].time += latest - medians[i];
    gfts.push_back(CalcContactTiming(contacts, 0.0).gft);
  }
  return CalcMedian(std::move(gfts));
}

}  // namespace

ContactTimesSummary SummariseContactTimes(const std::vector<LearningTrial>& trials) {
  ContactTimesSummary summary;
  std::vector<double> gft, got, gct;
  std::vector<std::vector<DigitContact>> timed;
  for (const LearningTrial& trial : trials) {
    ++summary.num_trials;
    if (!std::isfinite(trial.timing.gct) || trial.timing.contact_before_start) continue;
    ++summary.num_timed;
    gft.push_back(trial.timing.gft);
    got.push_back(trial.timing.got);
    gct.push_back(trial.timing.gct);
    timed.push_back(trial.contacts);
  }
  if (timed.empty()) return summary;
  summary.gft = CalcMedian(std::move(gft));
  summary.got = CalcMedian(std::move(got));
  summary.gct = CalcMedian(std::move(gct));
  summary.gft_floor = CalcGftFloorTime(timed);
  return summary;
}

}  // namespace graspbench
