// The part of a robot arm in a trial: its course, how far it gives way, how stiff it is.

#include <algorithm>
#include <cmath>

#include "core/arm/arm_inverse.h"
#include "core/base/text/text.h"
#include "core/trial/protocols/table_lift.h"

namespace graspbench {

using Eigen::Vector3d;

void TableLift::PlanArm(double before_arrival, WorldState& state) {
  const double distance = setup_.grasp.approach_distance;
  // A hand that seeks the palm goes on as far as it may.
  const double beyond = setup_.grasp.seeks_palm ? kPalmSearchLength - kPalmStandOff : 0.0;
  ArmTask task;
  task.object = setup_.object.get();
  task.X_WO = CalcBelievedPose();
  task.approach.X_WH = placement_.X_WH;
  task.approach.X_WH.pretranslate(-distance * placement_.approach_W);
  task.approach.motion_W = (distance + beyond) * placement_.approach_W;
  task.approach.time = setup_.strategy.placing_time;
  task.lift.X_WH = task.approach.X_WH;
  task.lift.X_WH.pretranslate(task.approach.motion_W);
  task.lift.motion_W = distance * Vector3d::UnitZ();
  task.lift.time = setup_.strategy.lift_time;
  ArmCourse course = PlanArmCourse(*setup_.arm, task);
  notes_.result.arm = std::move(course.record);
  notes_.arm_fault = course.fault;
  notes_.arm_reason = std::move(course.reason);
  if (course.fault != ArmFault::kNone) return;
  // The simulation starts on the way: from the knot that is nearest.
  const Pose X_BF = setup_.arm->X_WB.inverse() * state.X_WH * setup_.arm->X_FH.inverse();
  const auto miss = [&](const Eigen::VectorXd& q) {
    return (CalcFlangePose(*setup_.arm->arm, q).translation() - X_BF.translation()).norm();
  };
  const Eigen::VectorXd& knot =
      *std::min_element(course.approach.begin(), course.approach.end(),
                        [&](const auto& a, const auto& b) { return miss(a) < miss(b); });
  const std::optional<Eigen::VectorXd> q = RefinePosture(*setup_.arm->arm, X_BF, knot);
  Pose X_BNext = X_BF;  // a step later
  X_BNext.pretranslate(
      setup_.arm->X_WB.linear().transpose() *
      (CalcPlacingPose(before_arrival - setup_.sim.step).translation() - state.X_WH.translation()));
  const std::optional<Eigen::VectorXd> next =
      q ? RefinePosture(*setup_.arm->arm, X_BNext, *q) : std::nullopt;
  if (next) {
    SetArm(*setup_.arm, *q, state);
    state.u_arm = (*next - *q) / setup_.sim.step;
  } else {
    notes_.arm_fault = ArmFault::kNoStraightPath;
    notes_.arm_reason = "the arm has no posture on the approach";
  }
}

void TableLift::ObserveArm() {
  ArmRecord& arm = *notes_.result.arm;
  const StepReport& report = notes_.report;
  const Pose off = notes_.command.X_WH.inverse() * world_->state().X_WH;
  arm.deflection = std::fmax(arm.deflection, off.translation().norm());
  arm.deflection_angle = std::fmax(arm.deflection_angle, Eigen::AngleAxisd(off.linear()).angle());
  if (!(report.arm_torque_share <= arm.torque_share)) {
    arm.torque_share = report.arm_torque_share;
    arm.torque_joint = setup_.arm->arm->joints[static_cast<size_t>(report.arm_joint)].name;
  }
  if (report.is_followed) return;
  notes_.arm_fault = ArmFault::kNoStraightPath;
  notes_.arm_reason =
      "the arm cannot follow the hand " + FormatFixed(notes_.time, 2) + " s into the trial";
}

/** Of what carries the hand, along a direction at its present pose [N/m]. */
double TableLift::CalcArmStiffness(const Vector3d& direction_W) const {
  const WorldState& state = world_->state();
  if (!state.arm) return setup_.sim.arm_stiffness;
  std::vector<Pose> X_BL = CalcArmPoses(*state.arm->arm, state.q_arm);
  X_BL.back() = X_BL.back() * state.arm->X_FH;
  const auto C = CalcArmCompliance(*state.arm->arm, CalcArmJacobian(X_BL));
  const Vector3d direction_B = state.arm->X_WB.linear().transpose() * direction_W;
  return 1.0 / direction_B.dot(C.topLeftCorner<3, 3>() * direction_B);
}

}  // namespace graspbench
