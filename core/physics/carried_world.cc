#include <Eigen/Dense>
#include <cmath>

#include "core/physics/implicit_world.h"

// What carries the hand's base: a spring, or a robot arm. With the arm's Jacobian J and
// T = diag(1, J), the hand's mass matrix M and bias b in its joints and base become
//     T^T M T + diag(0, M_arm)   and   T^T (b + M [0; Jdot qdot])

namespace graspbench {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void ImplicitWorld::ResetArm() {
  arm_.reset();
  num_base_ = 6;
  if (!state_.arm) return;
  arm_.emplace(*state_.arm, state_.q_arm, state_.u_arm);
  num_base_ = arm_->num_joints();
  FinishArm();
}

VectorXd ImplicitWorld::FindSpeeds() const {
  VectorXd speeds(object_dof() + 6);
  if (arm_) {
    speeds << state_.u, state_.u_arm, state_.w_WO, state_.v_WOcm;
  } else {
    speeds << CalcHandSpeeds(), state_.w_WO, state_.v_WOcm;
  }
  return speeds;
}

VectorXd ImplicitWorld::CalcHandPart(const VectorXd& speeds) const {
  const int dofs = dynamics_.num_dofs();
  VectorXd result(dofs + 6);
  result << speeds.head(dofs), arm_->jacobian() * speeds.segment(dofs, num_base_);
  return result;
}

void ImplicitWorld::CalcArmMasses() {
  const int dofs = dynamics_.num_dofs();
  hand_mass_.resize(dofs + 6, dofs + 6);
  dynamics_.CalcMassMatrix(hand_mass_);
  AddArmatures(hand_mass_);
  const ArmJacobian& J = arm_->jacobian();
  arm_mass_ = arm_->CalcMass();
  problem_.M.topLeftCorner(dofs, dofs) = hand_mass_.topLeftCorner(dofs, dofs);
  const MatrixXd mixed = J.transpose() * hand_mass_.bottomLeftCorner(6, dofs);
  problem_.M.block(dofs, 0, num_base_, dofs) = mixed;
  problem_.M.block(0, dofs, dofs, num_base_) = mixed.transpose();
  problem_.M.block(dofs, dofs, num_base_, num_base_) =
      J.transpose() * hand_mass_.bottomRightCorner<6, 6>() * J + arm_mass_;
  // When a verdict turns gravity, it loads the object but not the arm.
  const Eigen::Vector3d gravity_W = MakeGravity(config_);
  arm_weight_ = arm_->CalcWeight(gravity_W) +
                J.transpose() * (hand_mass_.block<6, 3>(dofs, dofs + 3) * gravity_W);
}

void ImplicitWorld::ProjectContacts() {
  const int base = dynamics_.num_dofs();
  const ArmJacobian& J = arm_->jacobian();
  for (ContactPoint& contact : problem_.contacts) {
    int first = 0;
    while (first < contact.num_dofs && contact.dofs[first] < base) ++first;
    const bool moves_base = first < contact.num_dofs && contact.dofs[first] == base;
    const int kept = moves_base ? first + 6 : first;
    const int shift = num_base_ - 6, num_object = contact.num_dofs - kept;
    const int to = moves_base ? kept + shift : kept;
    std::array<int, 6> object_dofs = {};
    for (int i = 0; i < num_object; ++i) object_dofs[i] = contact.dofs[kept + i] + shift;
    for (auto& row : contact.jacobian) {
      const Eigen::Map<const Eigen::Matrix<double, 1, 6>> of_base(&row[first]);
      const std::array<double, 6> of_object = [&] {
        std::array<double, 6> values = {};
        for (int i = 0; i < num_object; ++i) values[i] = row[kept + i];
        return values;
      }();
      if (moves_base) {
        const VectorXd of_joints = (of_base * J).transpose();
        for (int i = 0; i < num_base_; ++i) row[first + i] = of_joints[i];
      }
      for (int i = 0; i < num_object; ++i) row[to + i] = of_object[i];
    }
    for (int i = 0; moves_base && i < num_base_; ++i) contact.dofs[first + i] = base + i;
    for (int i = 0; i < num_object; ++i) contact.dofs[to + i] = object_dofs[i];
    contact.num_dofs = to + num_object;
  }
}

void ImplicitWorld::AddArm(const WorldCommand& command) {
  const double h = problem_.h;
  for (int i = 0; arm_ && i < num_base_; ++i) {
    const ArmJoint& joint = arm_->joint(i);
    const double damping = joint.stiffness * config_.arm_damping_time;
    problem_.scalars.push_back({dynamics_.num_dofs() + i,
                                joint.stiffness * (arm_->q_command()[i] - middle_.q_arm[i]) +
                                    damping * arm_->u_command()[i],
                                0.5 * joint.stiffness * h + damping, arm_weight_[i] - joint.torque,
                                arm_weight_[i] + joint.torque});
  }
  if (arm_) return;
  const Eigen::AngleAxisd turn(
      Eigen::Matrix3d(command.X_WH.linear() * middle_.X_WH.linear().transpose()));
  const Eigen::Vector3d turned = turn.angle() * turn.axis();
  const Eigen::Vector3d moved = command.X_WH.translation() - middle_.X_WH.translation();
  const auto add = [&](int dof, double stiffness, double distance, double speed, double limit) {
    const double damping = stiffness * config_.arm_damping_time;
    problem_.scalars.push_back({dof, stiffness * distance + damping * speed,
                                0.5 * stiffness * h + damping, -limit, limit});
  };
  const int base = dynamics_.num_dofs();
  for (int k = 0; k < 3; ++k) {
    add(base + k, config_.arm_angular_stiffness, turned[k], command.w_WH[k],
        config_.arm_moment_limit);
  }
  for (int k = 0; k < 3; ++k) {
    add(base + 3 + k, config_.arm_stiffness, moved[k], command.v_WH[k], config_.arm_force_limit);
  }
}

void ImplicitWorld::CalcArmBias(const VectorXd& mean_speeds) {
  const int dofs = dynamics_.num_dofs();
  const ArmJacobian& J = arm_->jacobian();
  VectorXd hand_bias(dofs + 6);
  dynamics_.CalcBias(CalcHandPart(mean_speeds), state_.gravity_W, hand_bias);
  hand_bias +=
      hand_mass_.rightCols<6>() * arm_->CalcVelocityTerm(mean_speeds.segment(dofs, num_base_));
  const VectorXd inertia =
      problem_.M.block(dofs, dofs, num_base_, num_base_) * arm_->acceleration_command();
  arm_carrying_ = J.transpose() * hand_bias.tail<6>() + inertia;
  problem_.bias.head(dofs) = hand_bias.head(dofs);
  problem_.bias.segment(dofs, num_base_) = -inertia;
}

void ImplicitWorld::FinishArmForces(const VectorXd& v, const VectorXd& mean) {
  const double h = problem_.h;
  const int dofs = dynamics_.num_dofs();
  energy_.gravity +=
      h * (CalcHandPart(mean).dot(hand_mass_.middleCols<3>(dofs + 3) * state_.gravity_W) +
           mass_.mass * state_.gravity_W.dot(mean.tail<3>()));
  // The hand receives what the drives give beyond their springs, less what moves the arm itself.
  const VectorXd change = (v - problem_.u).segment(dofs, num_base_);
  energy_.arm += (h * arm_carrying_ - arm_mass_ * change).dot(mean.segment(dofs, num_base_));
}

void ImplicitWorld::FinishArm() {
  arm_->Update(state_.q_arm);
  state_.X_WH = arm_->X_WH();
  const Eigen::Matrix<double, 6, 1> speeds = arm_->jacobian() * state_.u_arm;
  state_.w_WH = speeds.head<3>();
  state_.v_WH = speeds.tail<3>();
}

void ImplicitWorld::ReportTorques(const VectorXd& torques, StepReport& report) const {
  for (int i = 0; i < num_base_; ++i) {
    const double share = std::abs(torques[i] - arm_weight_[i]) / arm_->joint(i).torque;
    if (i > 0 && share <= report.arm_torque_share) continue;
    report.arm_joint = i;
    report.arm_torque_share = share;
  }
}

}  // namespace graspbench
