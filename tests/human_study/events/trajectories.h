#pragma once
/** @file
Paths with known events, sampled evenly. */

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "human_study/events/reach_trial.h"
#include "human_study/events/scalar_curve.h"
#include "tests/human_study/faults.h"

namespace graspbench {

/** From 0 to 1 between two instants, at rest before and after: a minimum-jerk movement. */
inline double Ease(double t, double begin, double end) {
  const double u = std::clamp((t - begin) / (end - begin), 0.0, 1.0);
  return u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
}

inline Trajectory SamplePath(const std::vector<double>& times,
                             const std::function<Eigen::Vector3d(double)>& path) {
  Trajectory trajectory;
  trajectory.times = times;
  trajectory.states.assign(times.size(), SampleState::kMeasured);
  trajectory.p.resize(3, static_cast<Eigen::Index>(times.size()));
  for (size_t i = 0; i < times.size(); ++i) {
    trajectory.At(i) = path(times[i]);
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
    curve.At(i) = value(times[i]);
  }
  return curve;
}

inline void HideSamples(Trajectory& trajectory, double begin, double end) {
  const SampleRun run = FindSamples(trajectory.times, begin, end);
  for (size_t i = run.first; i < run.last; ++i) {
    trajectory.states[i] = SampleState::kInvalid;
    trajectory.At(i).setConstant(std::nan(""));
  }
}

}  // namespace graspbench
