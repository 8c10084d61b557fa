#pragma once
/** @file
One point over time in SI units and double precision, for cleaning and analysis. */

#include <Eigen/Core>
#include <vector>

#include "human_study/recording/recording.h"

namespace graspbench {

struct Trajectory {
  std::vector<double> times;        ///< [s], increasing
  Eigen::Matrix3Xd p;               ///< [m], one column per sample; NaN where invalid
  std::vector<SampleState> states;  ///< a filled sample must not decide an event without a flag

  size_t size() const { return times.size(); }
  auto At(size_t i) const { return p.col(static_cast<Eigen::Index>(i)); }
  auto At(size_t i) { return p.col(static_cast<Eigen::Index>(i)); }
  bool IsValid(size_t i) const { return states[i] != SampleState::kInvalid; }
};

/** @throws Error(kNotFound) for an unknown label, Error(kFormat) when the length unit or the rate
is unknown. */
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

// Resampling from uneven time stamps to an even clock, as filters need.
struct SamplingReport {
  double median_interval = 0.0;  ///< [s]; all values are NaN below two samples
  double longest_interval = 0.0;
  double shortest_interval = 0.0;
  /** All intervals lie within 1 % of the median. */
  bool is_even = true;
};

SamplingReport FindSampling(const std::vector<double>& times);

/** Interpolates linearly at first time + k / rate, up to the last time.

A new sample that coincides with an old one (within 1e-9 s) keeps its state. Between two valid old
samples no more than `max_interval` [s] apart it is measured, or filled when one of them is filled;
otherwise it is invalid. Linear interpolation is a mild low-pass: at 1/10 of the sampling rate it
attenuates by at most 5 %.
@pre rate > 0, max_interval > 0. */
Trajectory Resample(const Trajectory& trajectory, double rate, double max_interval);

}  // namespace graspbench
