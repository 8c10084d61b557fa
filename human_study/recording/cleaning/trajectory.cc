#include "human_study/recording/cleaning/trajectory.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/statistics/summary.h"

namespace graspbench {

namespace {

std::vector<SampleRun> FindRuns(const Trajectory& trajectory, bool valid) {
  std::vector<SampleRun> runs;
  for (size_t i = 0; i < trajectory.size(); ++i) {
    if (trajectory.IsValid(i) != valid) continue;
    if (runs.empty() || runs.back().last != i) runs.push_back({i, i});
    runs.back().last = i + 1;
  }
  return runs;
}

}  // namespace

Trajectory MakeTrajectory(const Recording& recording, const std::string& label) {
  const RecordedPoint& point = recording.FindPoint(label);
  if (!point.IsLength()) {
    throw Error(ErrorKind::kFormat, "\"" + label + "\" has " +
                                        (point.unit.empty() ? "no unit" : "unit " + point.unit) +
                                        ", so it is no position in metres; state the length unit "
                                        "if it is one (--unit mm)");
  }
  if (recording.times.empty() && !std::isfinite(recording.rate)) {
    throw Error(ErrorKind::kFormat, "the recording states neither a rate nor time stamps");
  }
  Trajectory trajectory;
  trajectory.p.resize(3, static_cast<Eigen::Index>(recording.num_frames));
  trajectory.states = point.states;
  for (size_t i = 0; i < recording.num_frames; ++i) {
    trajectory.times.push_back(recording.Time(i));
    trajectory.At(i) = point.Position(i);
  }
  return trajectory;
}

std::vector<SampleRun> FindValidRuns(const Trajectory& trajectory) {
  return FindRuns(trajectory, true);
}

std::vector<SampleRun> FindGaps(const Trajectory& trajectory) {
  return FindRuns(trajectory, false);
}

SamplingReport FindSampling(const std::vector<double>& times) {
  SamplingReport report;
  if (times.size() < 2) {
    report.median_interval = report.longest_interval = report.shortest_interval = std::nan("");
    return report;
  }
  std::vector<double> intervals;
  for (size_t i = 1; i < times.size(); ++i) intervals.push_back(times[i] - times[i - 1]);
  const auto [shortest, longest] = std::minmax_element(intervals.begin(), intervals.end());
  report.shortest_interval = *shortest;
  report.longest_interval = *longest;
  report.median_interval = CalcMedian(std::move(intervals));
  report.is_even = report.longest_interval <= 1.01 * report.median_interval &&
                   report.shortest_interval >= 0.99 * report.median_interval;
  return report;
}

Trajectory Resample(const Trajectory& trajectory, double rate, double max_interval) {
  constexpr double kSameTime = 1e-9;
  Trajectory even;
  if (trajectory.size() == 0) return even;
  const double start = trajectory.times.front();
  const auto count =
      static_cast<size_t>(std::floor((trajectory.times.back() - start) * rate + 1e-6)) + 1;
  even.p.setConstant(3, static_cast<Eigen::Index>(count), std::nan(""));
  even.states.assign(count, SampleState::kInvalid);
  size_t after = 0;  // first old sample not before the new time
  for (size_t k = 0; k < count; ++k) {
    const double time = start + static_cast<double>(k) / rate;
    even.times.push_back(time);
    while (after + 1 < trajectory.size() && trajectory.times[after] < time - kSameTime) ++after;
    const auto column = static_cast<Eigen::Index>(after);
    if (std::abs(trajectory.times[after] - time) <= kSameTime) {
      even.At(k) = trajectory.p.col(column);
      even.states[k] = trajectory.states[after];
      continue;
    }
    if (after == 0) continue;
    const double interval = trajectory.times[after] - trajectory.times[after - 1];
    if (!trajectory.IsValid(after - 1) || !trajectory.IsValid(after) || interval > max_interval) {
      continue;
    }
    const double s = (time - trajectory.times[after - 1]) / interval;
    even.At(k) = (1 - s) * trajectory.p.col(column - 1) + s * trajectory.p.col(column);
    const bool is_filled = trajectory.states[after - 1] == SampleState::kFilled ||
                           trajectory.states[after] == SampleState::kFilled;
    even.states[k] = is_filled ? SampleState::kFilled : SampleState::kMeasured;
  }
  return even;
}

}  // namespace graspbench
