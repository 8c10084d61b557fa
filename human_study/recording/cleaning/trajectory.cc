#include "human_study/recording/cleaning/trajectory.h"

#include "core/base/error.h"

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
    trajectory.p.col(static_cast<Eigen::Index>(i)) = point.Position(i);
  }
  return trajectory;
}

std::vector<SampleRun> FindValidRuns(const Trajectory& trajectory) {
  return FindRuns(trajectory, true);
}

std::vector<SampleRun> FindGaps(const Trajectory& trajectory) {
  return FindRuns(trajectory, false);
}

}  // namespace graspbench
