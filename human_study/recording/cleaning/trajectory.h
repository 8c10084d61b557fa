#pragma once
/** @file
One point over time in SI units and double precision: what cleaning and analysis work on. */

#include <Eigen/Core>
#include <vector>

#include "human_study/recording/recording.h"

namespace graspbench {

struct Trajectory {
  std::vector<double> times;        ///< [s], increasing
  Eigen::Matrix3Xd p;               ///< [m], a column a sample; NaN where invalid
  std::vector<SampleState> states;  ///< a filled sample must not decide an event without a flag

  size_t size() const { return times.size(); }
  bool IsValid(size_t i) const { return states[i] != SampleState::kInvalid; }
};

/** @throws Error(kNotFound) for an unknown label, Error(kFormat) when the length unit or the rate
is not known. */
Trajectory MakeTrajectory(const Recording& recording, const std::string& label);

/** A run of samples [first, last). */
struct SampleRun {
  size_t first = 0;
  size_t last = 0;
  size_t size() const { return last - first; }
};

/** Runs of valid samples, in order. */
std::vector<SampleRun> FindValidRuns(const Trajectory& trajectory);
/** Runs of invalid samples, in order. */
std::vector<SampleRun> FindGaps(const Trajectory& trajectory);

}  // namespace graspbench
