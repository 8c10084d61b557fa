#include "human_study/study/inference/phase_course.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/statistics/summary.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {

PhaseCourse SummarisePhases(const std::vector<PhaseTimes>& trials) {
  PhaseCourse course;
  for (size_t i = 0; i < kNumPhaseInstants; ++i) {
    std::vector<double> shares;
    for (const PhaseTimes& at : trials) {
      const double length = at[kLiftOff] - at[kOnset];
      if (length > 0.0) shares.push_back((at[i] - at[kOnset]) / length);
    }
    course.num_trials[i] = static_cast<int>(std::count_if(
        shares.begin(), shares.end(), [](double share) { return std::isfinite(share); }));
    course.at[i] = CalcMedianOfFinite(std::move(shares));
  }
  return course;
}

PhaseCourse SummarisePhases(const std::vector<StudyTrial>& trials) {
  std::vector<PhaseTimes> times;
  for (const StudyTrial& trial : trials) {
    if (!trial.IsKept()) continue;
    const TrialAnalysis& a = *trial.analysis;
    times.push_back({a.movement.onset.time, a.closure_start.time, a.phases.reacceleration.time,
                     a.movement.end.time, a.closure_start.time + a.timing.gct,
                     a.object.lift_off.time});
  }
  return SummarisePhases(times);
}

}  // namespace graspbench
