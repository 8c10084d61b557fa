#include "core/physics/world.h"

#include <algorithm>

#include "core/arm/mounted_arm.h"

namespace graspbench {

void SetArm(const MountedArm& arm, const Eigen::VectorXd& q, WorldState& state) {
  state.arm = &arm;
  state.q_arm = q;
  state.u_arm = Eigen::VectorXd::Zero(q.size());
  state.X_WH = arm.X_WB * CalcFlangePose(*arm.arm, q) * arm.X_FH;
  state.w_WH.setZero();
  state.v_WH.setZero();
}

Pose CalcPalmPose(const Hand& hand, const WorldState& state) {
  return state.X_WH * CalcLinkPose(hand, state.q, hand.palm_link);
}

double CalcDrivePosition(const Hand& hand, const WorldState& state, int joint) {
  double position = state.q[joint];
  if (hand.coupling != CouplingRule::kMiddleFirst) return position;
  for (int other = 0; other < hand.num_joints(); ++other) {
    const HandJoint& coupled = hand.joints[static_cast<size_t>(other)];
    if (coupled.coupled_to != joint || coupled.is_mimic) continue;
    position += state.q[other] - (state.deviation.size() > 0 ? state.deviation[other] : 0.0);
  }
  return position;
}

const char* DescribeState(const HandContact& contact) {
  return !contact.is_at_limit ? "sticks" : IsSliding(contact) ? "slides" : "at its limit";
}

double CalcConeShare(const HandContact& contact) {
  const double limit = contact.mu * contact.normal_force;
  return limit > 0.0 ? contact.friction_W.norm() / limit : kUnset;
}

World::World(const Hand& hand, const GraspObject& object, const SimConfig& config,
             TablePresence table)
    : hand_(&hand),
      mass_(object.mass_properties),
      dynamics_(hand),
      collider_(hand, object, config, table) {}

void World::ResetScene(const WorldState& state) {
  state_ = state;
  if (state_.deviation.size() == 0) {
    state_.deviation = Eigen::VectorXd::Zero(dynamics_.num_joints());
  }
  const int dofs = dynamics_.num_dofs();
  modes_.assign(static_cast<size_t>(dofs), DistalMode::kMiddleMoves);
  for (int dof = 0; dof < dofs; ++dof) {
    if (dynamics_.distal_of_dof(dof) >= 0) SetDistalRates(dof);
  }
  link_blocks_.assign(hand_->links.size(), false);
  collider_.Reset();
}

Pose World::CalcObjectPose() const {
  return MakePose(state_.R_WO, state_.p_WOcm - state_.R_WO * mass_.p_OOcm);
}

Eigen::VectorXd World::CalcHandSpeeds() const {
  Eigen::VectorXd u(dynamics_.num_speeds());
  u << state_.u, state_.w_WH, state_.v_WH;
  return u;
}

void World::AddArmatures(Eigen::MatrixXd& M) const {
  for (int dof = 0; dof < dynamics_.num_dofs(); ++dof) {
    if (dynamics_.is_deviation(dof)) continue;
    M(dof, dof) += hand_->joints[dynamics_.joint_of_dof(dof)].drive.armature;
  }
}

double World::CalcKineticEnergy() {
  dynamics_.UpdatePositions(state_.X_WH, state_.q);
  Eigen::MatrixXd M(dynamics_.num_speeds(), dynamics_.num_speeds());
  dynamics_.CalcMassMatrix(M);
  AddArmatures(M);
  const Eigen::VectorXd u = CalcHandSpeeds();
  const Eigen::Vector3d w_O = state_.R_WO.transpose() * state_.w_WO;
  return 0.5 *
         (u.dot(M * u) + w_O.dot(mass_.I_OOcm * w_O) + mass_.mass * state_.v_WOcm.squaredNorm());
}

void World::ChooseDistalModes(const WorldCommand& command, double& stop_work) {
  if (hand_->coupling != CouplingRule::kMiddleFirst) return;
  for (int dof = 0; dof < dynamics_.num_dofs(); ++dof) {
    const int distal = dynamics_.distal_of_dof(dof);
    if (distal < 0) continue;
    const int middle = dynamics_.joint_of_dof(dof);
    const int middle_link = hand_->joints[middle].link;
    const int proximal_link = hand_->links[middle_link].parent;
    const double coupled = state_.q[distal] - state_.deviation[distal];
    const double theta = state_.q[middle] + coupled;
    const bool blocked = link_blocks_[middle_link] || link_blocks_[proximal_link];
    const DistalMode mode = FindDistalMode(state_.q[middle], coupled, hand_->joints[middle].upper,
                                           command.q[middle] > theta, blocked, modes_[dof]);
    if (mode == modes_[dof]) continue;
    // The moving joint reaches its stop and starts from rest in its new direction.
    const double before = CalcKineticEnergy();
    state_.u[dof] = 0.0;
    if (mode == DistalMode::kMiddleMoves && coupled < 0.0) {
      state_.q[distal] = state_.deviation[distal];
    }
    stop_work += CalcKineticEnergy() - before;
    modes_[dof] = mode;
    SetDistalRates(dof);
  }
}

void World::SetDistalRates(int dof) {
  const DistalRates rates =
      CalcDistalRates(hand_->coupling, hand_->fixed_coupling_ratio, modes_[dof]);
  dynamics_.SetRate(dynamics_.joint_of_dof(dof), rates.middle);
  dynamics_.SetRate(dynamics_.distal_of_dof(dof), rates.distal);
}

}  // namespace graspbench
