#include "core/trial/judge/disturbance.h"

#include <Eigen/Geometry>
#include <algorithm>

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

void ClosingMeter::Observe(Phase phase, const Pose& X_WO) {
  if (!start_ && phase >= Phase::kClosure) start_ = X_WO;
  has_ended_ = has_ended_ || phase >= Phase::kStabilisation;
  if (!has_ended_) last_ = X_WO;
}

Displacement ClosingMeter::Calc() const {
  return start_ ? CalcDisplacement(*start_, last_) : Displacement();
}

}  // namespace graspbench
