#pragma once
/** @file
A number over time with the state of every sample (speed, distance, hand opening), and the few
questions that rules ask of one. */

#include <Eigen/Core>
#include <vector>

#include "human_study/cleaning/trajectory.h"
#include "human_study/events/event_time.h"

namespace graspbench {

struct ScalarCurve {
  std::vector<double> times;  ///< [s], even
  Eigen::VectorXd values;     ///< NaN where invalid
  std::vector<SampleState> states;

  size_t size() const { return times.size(); }
  bool IsValid(size_t i) const { return states[i] != SampleState::kInvalid; }
  double Interval() const { return times[1] - times[0]; }  ///< [s] @pre size() >= 2
};

/** Worse of two: a value computed from both is filled when one is, invalid when one is. */
SampleState CombineStates(SampleState a, SampleState b);

/** Speed by central differences (one-sided at the ends of a run) [m/s]. A valid sample without
valid neighbours is invalid. */
ScalarCurve CalcSpeed(const Trajectory& trajectory);

/** The same curve run backwards in time: t -> -t. */
ScalarCurve Reverse(const ScalarCurve& curve);

/** Sample index range [first, last) with begin <= time <= end. */
SampleRun FindSamples(const std::vector<double>& times, double begin, double end);

/** Goes from sample `from`, where the curve is above (or below) the threshold, backwards to sample
`first` at the earliest, and gives the latest instant at which it was not: linear between samples,
the middle of a gap, with its uncertainty from sampling and gap. Missing when it never was.
@param is_filled_within  [s] filled samples as near as this set the flag: the filter's reach. */
EventTime TraceBack(const ScalarCurve& curve, size_t from, size_t first, double threshold,
                    bool is_above, double is_filled_within);

}  // namespace graspbench
