#pragma once
/** @file
Paths with known events, sampled evenly. */

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "core/base/error.h"
#include "human_study/events/reach_trial.h"
#include "human_study/events/scalar_curve.h"

namespace graspbench {

inline Trajectory SamplePath(const std::vector<double>& times,
                             const std::function<Eigen::Vector3d(double)>& path) {
  Trajectory trajectory;
  trajectory.times = times;
  trajectory.states.assign(times.size(), SampleState::kMeasured);
  trajectory.p.resize(3, static_cast<Eigen::Index>(times.size()));
  for (size_t i = 0; i < times.size(); ++i) {
    trajectory.p.col(static_cast<Eigen::Index>(i)) = path(times[i]);
  }
  return trajectory;
}

inline std::vector<double> MakeTimes(double begin, double end, double rate) {
  std::vector<double> times;
  for (int k = 0; begin + k / rate <= end + 1e-9; ++k) times.push_back(begin + k / rate);
  return times;
}

inline ScalarCurve SampleCurve(const std::vector<double>& times,
                               const std::function<double(double)>& value) {
  ScalarCurve curve;
  curve.times = times;
  curve.states.assign(times.size(), SampleState::kMeasured);
  curve.values.resize(static_cast<Eigen::Index>(times.size()));
  for (size_t i = 0; i < times.size(); ++i) {
    curve.values[static_cast<Eigen::Index>(i)] = value(times[i]);
  }
  return curve;
}

inline void HideSamples(Trajectory& trajectory, double begin, double end) {
  const SampleRun run = FindSamples(trajectory.times, begin, end);
  for (size_t i = run.first; i < run.last; ++i) {
    trajectory.states[i] = SampleState::kInvalid;
    trajectory.p.col(static_cast<Eigen::Index>(i)).setConstant(std::nan(""));
  }
}

/** Message of the Error that a call throws; empty when it throws none. */
inline std::string FaultOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace graspbench
