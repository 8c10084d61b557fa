#include "core/trial/judge/disturbance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>

namespace graspbench {
namespace {

/** Null when the trial ended before it. */
const SceneSnapshot* FindSnapshot(const TrialResult& result, Moment moment) {
  const auto found =
      std::find_if(result.snapshots.begin(), result.snapshots.end(),
                   [moment](const SceneSnapshot& snapshot) { return snapshot.moment == moment; });
  return found == result.snapshots.end() ? nullptr : &*found;
}

Displacement CalcDisplacement(const Pose& before, const Pose& after) {
  const Eigen::Matrix3d turn = before.linear().transpose() * after.linear();
  return {(after.translation() - before.translation()).norm(), Eigen::AngleAxisd(turn).angle()};
}

}  // namespace

Disturbance CalcDisturbance(const TrialResult& result) {
  Disturbance disturbance;
  const SceneSnapshot* start = FindSnapshot(result, Moment::kPreGrasp);
  const SceneSnapshot* end = FindSnapshot(result, Moment::kLifted);
  if (!start || !end) return disturbance;
  const SceneSnapshot* closed = FindSnapshot(result, Moment::kClosed);
  disturbance.before_lift = CalcDisplacement(start->X_WO, closed ? closed->X_WO : end->X_WO);
  disturbance.in_hand =
      CalcDisplacement(start->X_WH.inverse() * start->X_WO, end->X_WH.inverse() * end->X_WO);
  return disturbance;
}

Displacement CalcClosingDisplacement(const std::vector<TraceInstant>& trace) {
  const auto find_first = [&trace](Phase phase) {
    return std::find_if(trace.begin(), trace.end(),
                        [phase](const TraceInstant& instant) { return instant.phase >= phase; });
  };
  const auto start = find_first(Phase::kClosure), end = find_first(Phase::kStabilisation);
  if (start == trace.end()) return {};
  return CalcDisplacement(start->X_WO, std::prev(end)->X_WO);
}

}  // namespace graspbench
