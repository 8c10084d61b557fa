#include "core/physics/carrying_arm.h"

#include <Eigen/Dense>

#include "core/arm/arm_inverse.h"
#include "core/physics/world.h"

namespace graspbench {
namespace {

using Eigen::VectorXd;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/** Keeps J J^T invertible at a singular posture. */
constexpr double kDamping = 1e-12;

/** Returns the shortest x with J x = y, where one exists. */
VectorXd SolveShortest(const ArmJacobian& J, const Vector6d& y) {
  const Matrix6d gram = J * J.transpose() + kDamping * Matrix6d::Identity();
  return J.transpose() * gram.ldlt().solve(y);
}

/** Converts [linear; angular] in B to [angular; linear] in W. */
Vector6d TurnToWorld(const Pose& X_WB, const Vector6d& linear_first) {
  Vector6d result;
  result << X_WB.linear() * linear_first.tail<3>(), X_WB.linear() * linear_first.head<3>();
  return result;
}

/** Poses of CalcArmPoses, but the last one is that of H. */
std::vector<Pose> CalcHandPoses(const MountedArm& arm, const VectorXd& q) {
  std::vector<Pose> X_BL = CalcArmPoses(*arm.arm, q);
  X_BL.back() = X_BL.back() * arm.X_FH;
  return X_BL;
}

ArmJacobian CalcHandJacobian(const MountedArm& arm, const std::vector<Pose>& X_BL) {
  ArmJacobian J = CalcArmJacobian(X_BL);
  for (Eigen::Index i = 0; i < J.cols(); ++i) J.col(i) = TurnToWorld(arm.X_WB, J.col(i));
  return J;
}

}  // namespace

CarryingArm::CarryingArm(const MountedArm& arm, const VectorXd& q, const VectorXd& u)
    : arm_(&arm), q_command_(q), u_command_(u), acceleration_command_(VectorXd::Zero(q.size())) {
  Update(q);
  X_WH_command_ = X_WH_;
}

void CarryingArm::Update(const VectorXd& q) {
  X_BL_ = CalcHandPoses(*arm_, q);
  X_WH_ = arm_->X_WB * X_BL_.back();
  J_ = CalcHandJacobian(*arm_, X_BL_);
}

std::vector<Pose> CarryingArm::ListLinkPoses() const {
  std::vector<Pose> X_BL = X_BL_;
  X_BL.back() = X_BL.back() * arm_->X_FH.inverse();
  return X_BL;
}

bool CarryingArm::Follow(const WorldCommand& command, double h) {
  const VectorXd before = u_command_;
  u_command_.setZero();
  bool follows = true;
  if (command.q_arm.size() > 0) {
    q_command_ = command.q_arm;
    u_command_ = command.u_arm;
    X_WH_command_ = command.X_WH;
  } else if (command.X_WH.matrix() != X_WH_command_.matrix() || !command.v_WH.isZero(0.0) ||
             !command.w_WH.isZero(0.0)) {
    const Pose X_BF = arm_->X_WB.inverse() * command.X_WH * arm_->X_FH.inverse();
    const std::optional<VectorXd> q =
        RefinePosture(*arm_->arm, X_BF, VectorXd(q_command_ + h * before));
    follows = q && FindLimitMargin(*arm_->arm, *q).margin >= 0.0;
    if (follows) {
      q_command_ = *q;
      X_WH_command_ = command.X_WH;
      Vector6d speeds;
      speeds << command.w_WH, command.v_WH;
      u_command_ = SolveShortest(CalcHandJacobian(*arm_, CalcHandPoses(*arm_, q_command_)), speeds);
    }
  }
  acceleration_command_ = (u_command_ - before) / h;
  return follows;
}

Vector6d CarryingArm::CalcVelocityTerm(const VectorXd& u) const {
  return TurnToWorld(arm_->X_WB, CalcArmVelocityTerm(X_BL_, u));
}

Eigen::MatrixXd CarryingArm::CalcMass() const { return CalcArmMass(*arm_->arm, ListLinkPoses()); }

VectorXd CarryingArm::CalcWeight(const Eigen::Vector3d& gravity_W) const {
  return CalcArmWeight(*arm_->arm, ListLinkPoses(), arm_->X_WB.linear().transpose() * gravity_W);
}

Vector6d CarryingArm::CalcBaseForce(const VectorXd& tau) const {
  const Matrix6d gram = J_ * J_.transpose() + kDamping * Matrix6d::Identity();
  return gram.ldlt().solve(J_ * tau);
}

}  // namespace graspbench
