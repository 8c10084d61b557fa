#pragma once
/** @file
From uneven time stamps to an even clock, which filters need. */

#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

struct SamplingReport {
  double median_interval = 0.0;  ///< [s]; NaN below two samples, as all
  double longest_interval = 0.0;
  double shortest_interval = 0.0;
  /** All intervals lie within 1 % of the median. */
  bool is_even = true;
};

SamplingReport FindSampling(const std::vector<double>& times);

/** Linear interpolation at first time + k / rate, up to the last time.

A new sample that falls on an old one (within 1e-9 s) keeps its state. Between two valid old samples
no more than `max_interval` [s] apart it is measured, or filled when one of them is filled;
otherwise it is invalid. Linear interpolation is a mild low-pass: at 1/10 of the sampling rate it
takes away at most 5 %.
@pre rate > 0, max_interval > 0. */
Trajectory Resample(const Trajectory& trajectory, double rate, double max_interval);

}  // namespace graspbench
