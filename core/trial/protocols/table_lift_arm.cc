// The part of a robot arm in a trial: its course, how far it gives way, how stiff it is.

#include <algorithm>
#include <cmath>

#include "core/arm/arm_inverse.h"
#include "core/base/minimum_jerk.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/physics/carrying_arm.h"
#include "core/trial/protocols/table_lift.h"

namespace graspbench {

using Eigen::Vector3d;

bool TableLift::StartReach() {
  const double distance = setup_.grasp.approach_distance;
  // A hand that seeks the palm goes on as far as it may.
  const double beyond = setup_.grasp.seeks_palm ? kPalmSearchLength - kPalmStandOff : 0.0;
  ArmTask task;
  task.object = setup_.object.get();
  task.X_WO = CalcBelievedPose();
  task.approach.X_WH = CalcPlacingPose(setup_.strategy.placing_time);
  task.approach.motion_W = (distance + beyond - notes_.palm.offset()) * placement_.approach_W;
  task.approach.time = setup_.strategy.placing_time;
  task.lift.X_WH = task.approach.X_WH;
  task.lift.X_WH.pretranslate(task.approach.motion_W);
  task.lift.motion_W = distance * Vector3d::UnitZ();
  task.lift.time = setup_.strategy.lift_time;
  task.hand = &hand_;
  task.q_rest = ApplyError(CalcRestPosture(hand_));
  task.q_pre = ApplyError(setup_.grasp.q_pre);
  ArmCourse course = PlanArmCourse(*setup_.arm, task);
  notes_.result.arm = std::move(course.record);
  notes_.arm_fault = course.fault;
  notes_.arm_reason = std::move(course.reason);
  if (course.fault != ArmFault::kNone || notes_.start_gap < 0.0) return false;
  notes_.q_reached = course.approach.front();
  WorldState state = world_->state();
  state.q = task.q_rest;
  SetArm(*setup_.arm, setup_.arm->arm->ready, state);
  world_->Reset(state);
  return true;
}

void TableLift::Reach(WorldCommand& command) const {
  const MountedArm& mounted = *setup_.arm;
  const double time = notes_.result.arm->reach_time;
  const double x = std::min(1.0, notes_.strategy.time_in_phase() / time);
  const double share = CalcMinimumJerk(x), rate = CalcMinimumJerkRate(x) / time;
  const Eigen::VectorXd turn = notes_.q_reached - mounted.arm->ready;
  command.q_arm = mounted.arm->ready + share * turn;
  command.u_arm = rate * turn;
  const CarryingArm arm(mounted, command.q_arm, command.u_arm);
  const Eigen::Matrix<double, 6, 1> speeds = arm.jacobian() * command.u_arm;
  command.X_WH = arm.X_WH();
  command.w_WH = speeds.head<3>();
  command.v_WH = speeds.tail<3>();
  command.q += (1.0 - share) * (CalcRestPosture(hand_) - setup_.grasp.q_pre);
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
  const LimitMargin nearest = FindLimitMargin(*setup_.arm->arm, world_->state().q_arm);
  arm.joint = setup_.arm->arm->joints[static_cast<size_t>(nearest.joint)].name;
  arm.margin = nearest.margin;
  notes_.arm_reason = "the arm cannot follow the hand " + FormatFixed(notes_.time, 2) +
                      " s into the trial; joint " + std::to_string(nearest.joint + 1) + " (" +
                      arm.joint + ") is " + FormatFixed(DegFromRad(nearest.margin), 1) +
                      " deg from its limit";
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
