#pragma once
/** @file
Compares closing schedules of a session's grasps on its own draws
(datasets/analysis/schedules/schedule_comparison.h). The comparison is a session `schedules/HASH` in
the folder of the first. Its grasps are those of the first on each object, one per schedule, as
grasp files that differ only in their closing. Its grip thresholds lie below it. So it is run,
stopped, continued, judged, verified and reported like any other session.

A closing is found by trials without variation (core/trial/digit_delays.h). A schedule is omitted
where a lag is off by more than kMostLagError of the natural closing time. */

#include <string>
#include <vector>

#include "datasets/analysis/schedules/schedule_comparison.h"
#include "workbench/experiments/session_experiment.h"

namespace graspbench {

inline constexpr double kMostLagError = 0.02;

struct People {
  std::string study;                  ///< as the user named it; empty: none
  std::vector<TrialTouches> touches;  ///< of its included trials
};

/** Creates the folder, or finds it. @throws Error(kUsage) for a session that has conditions or is
itself one of schedules, for a session whose grasps have no second schedule, and for a study with
none of its objects or digits; as PrepareExperiment. */
PreparedSession PrepareSchedules(const ExperimentRequest& request, const People& people);

}  // namespace graspbench
