#include "core/physics/implicit_world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/** Stiffness of the stops at the joint limits, and of a blocked joint [N m/rad]. */
constexpr double kLimitStiffness = 200.0;
/** Speeds may differ by this much from those the bias was taken at [rad/s, m/s]. */
constexpr double kBiasSpeedTolerance = 1e-5;

Matrix3d MakeRotation(const Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle < 1e-12) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
}

/** Takes out the rounding of many small turns. */
Matrix3d Orthonormalize(const Matrix3d& R) {
  return Eigen::Quaterniond(R).normalized().toRotationMatrix();
}

}  // namespace

ImplicitWorld::ImplicitWorld(const Hand& hand, const GraspObject& object, const SimConfig& config)
    : World(hand, object, config), config_(config) {
  const int n = dynamics_.num_dofs() + 6;
  problem_.h = config.step;
  problem_.M = Eigen::MatrixXd::Zero(n, n);
  problem_.u = VectorXd::Zero(n);
  problem_.bias = VectorXd::Zero(n);
  problem_.contacts.reserve(128);
}

std::unique_ptr<World> ImplicitWorld::Clone() const {
  return std::make_unique<ImplicitWorld>(*this);
}

void ImplicitWorld::Reset(const WorldState& state) {
  ResetScene(state);
  v_ = VectorXd::Zero(dynamics_.num_dofs() + 6);
  v_ << state.u, state.w_WO, state.v_WOcm;
  problem_.contacts.clear();
  step_number_ = 0;
  SetExternalLoad(Vector3d::Zero(), Vector3d::Zero());
  energy_ = EnergyAccount();
  energy_.kinetic_at_start = CalcKineticEnergy();
}

void ImplicitWorld::MovePositions(double h, const VectorXd& u, WorldState& state) const {
  const int dofs = dynamics_.num_dofs();
  for (int joint = 0; joint < dynamics_.num_joints(); ++joint) {
    state.q[joint] += h * dynamics_.rate_of_joint(joint) * u[dynamics_.dof_of_joint(joint)];
  }
  state.R_WO = MakeRotation(h * u.segment<3>(dofs)) * state.R_WO;
  state.p_WOcm += h * u.segment<3>(dofs + 3);
}

void ImplicitWorld::AddDrivesAndLimits(const WorldCommand& command) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double h = config_.step;
  problem_.scalars.clear();
  for (int dof = 0; dof < dynamics_.num_dofs(); ++dof) {
    const int joint = dynamics_.joint_of_dof(dof), distal = dynamics_.distal_of_dof(dof);
    const JointDrive& drive = hand_->joints[joint].drive;
    double theta = middle_.q[joint];
    if (distal >= 0 && hand_->coupling == CouplingRule::kMiddleFirst) theta += middle_.q[distal];
    problem_.scalars.push_back({dof, drive.stiffness * (command.q[joint] - theta),
                                0.5 * drive.stiffness * h + drive.damping, -drive.torque_limit,
                                drive.torque_limit});
  }
  num_drives_ = static_cast<int>(problem_.scalars.size());
  for (int joint = 0; joint < dynamics_.num_joints(); ++joint) {
    const double rate = dynamics_.rate_of_joint(joint);
    if (rate == 0.0) continue;
    double lower = hand_->joints[joint].lower, upper = hand_->joints[joint].upper;
    if (const int middle = hand_->joints[joint].coupled_to; middle >= 0) {
      if (hand_->coupling != CouplingRule::kMiddleFirst)
        continue;  // the middle joint's limits hold
      lower = std::max(lower, 0.0);
      upper = std::min(upper, middle_.q[middle]);  // the middle joint is never less bent
    }
    const int dof = dynamics_.dof_of_joint(joint);
    const double q = middle_.q[joint], gain = kLimitStiffness * h * rate * rate;
    // Far from its limits a joint cannot reach them within the step.
    constexpr double kNear = 0.1;
    if (q < lower + kNear) {
      problem_.scalars.push_back({dof, kLimitStiffness * rate * (lower - q), gain, 0.0, kInfinity});
    }
    if (q > upper - kNear) {
      problem_.scalars.push_back(
          {dof, kLimitStiffness * rate * (upper - q), gain, -kInfinity, 0.0});
    }
  }
}

double ImplicitWorld::CalcBias(const VectorXd& mean_speeds, const Vector3d& v_WH,
                               const Vector3d& lift_W, VectorXd& bias) const {
  const int dofs = dynamics_.num_dofs();
  const double power = dynamics_.CalcBias(mean_speeds, v_WH, lift_W, bias.head(dofs));
  const Vector3d w = mean_speeds.segment<3>(dofs), v = mean_speeds.segment<3>(dofs + 3);
  const Vector3d momentum = problem_.M.block<3, 3>(dofs, dofs) * w;
  bias.segment<3>(dofs) = w.cross(momentum) - external_moment_W_;
  bias.segment<3>(dofs + 3) = -mass_.mass * state_.gravity_W - external_force_W_;
  return power - mass_.mass * lift_W.dot(v - v_WH);
}

StepReport ImplicitWorld::Step(const WorldCommand& command) {
  const double h = config_.step;
  const int dofs = dynamics_.num_dofs();
  ChooseDistalModes(command, energy_.limits);
  problem_.u << state_.u, state_.w_WO, state_.v_WOcm;

  middle_ = state_;
  MovePositions(0.5 * h, problem_.u, middle_);
  middle_.X_WH.translation() = 0.5 * (state_.X_WH.translation() + command.X_WH.translation());
  dynamics_.UpdatePositions(middle_.X_WH, middle_.q);
  dynamics_.CalcMassMatrix(problem_.M.topLeftCorner(dofs, dofs));
  problem_.M.block<3, 3>(dofs, dofs) = middle_.R_WO * mass_.I_OOcm * middle_.R_WO.transpose();
  problem_.M.block<3, 3>(dofs + 3, dofs + 3) = mass_.mass * Matrix3d::Identity();

  const Pose X_WO = MakePose(middle_.R_WO, middle_.p_WOcm - middle_.R_WO * mass_.p_OOcm);
  collider_.FindContacts(dynamics_, X_WO, middle_.p_WOcm, command.v_WH, step_number_,
                         problem_.contacts);
  AddDrivesAndLimits(command);

  const Vector3d lift_W = (command.v_WH - state_.v_WH) / h - state_.gravity_W;
  const Vector3d mean_v_WH = 0.5 * (state_.v_WH + command.v_WH);
  VectorXd mean_speeds = 0.5 * (problem_.u + v_);
  double power = CalcBias(mean_speeds, mean_v_WH, lift_W, problem_.bias);
  const bool converged = solver_.Solve(problem_, v_, [&](const VectorXd& v) {
    const VectorXd refreshed = 0.5 * (problem_.u + v);
    if ((refreshed - mean_speeds).cwiseAbs().maxCoeff() < kBiasSpeedTolerance) return false;
    mean_speeds = refreshed;
    power = CalcBias(mean_speeds, mean_v_WH, lift_W, problem_.bias);
    return true;
  });

  for (size_t c = 0; c < problem_.contacts.size(); ++c) {
    FinishContact(problem_.contacts[c], solver_.rates()[c], solver_.forces()[c], h, step_number_);
  }
  AccountEnergy(v_, mean_v_WH, power);
  StepReport report = MakeReport(v_, converged);
  UpdateBlocks(report.link_touches_object);

  state_ = middle_;
  MovePositions(0.5 * h, v_, state_);
  state_.R_WO = Orthonormalize(state_.R_WO);
  state_.X_WH = command.X_WH;
  state_.v_WH = command.v_WH;
  state_.u = v_.head(dofs);
  state_.w_WO = v_.segment<3>(dofs);
  state_.v_WOcm = v_.segment<3>(dofs + 3);
  ++step_number_;
  report.is_finite = v_.allFinite() && state_.p_WOcm.allFinite();
  return report;
}

void ImplicitWorld::AccountEnergy(const VectorXd& v, const Vector3d& mean_v_WH, double power) {
  const double h = config_.step;
  const VectorXd mean = 0.5 * (problem_.u + v);
  energy_.gravity += h * power;
  energy_.external += h * (external_moment_W_.dot(mean.tail<6>().head<3>()) +
                           external_force_W_.dot(mean.tail<3>() - mean_v_WH));
  for (size_t i = 0; i < problem_.scalars.size(); ++i) {
    const ScalarForce& scalar = problem_.scalars[i];
    const double tau =
        std::clamp(scalar.offset - scalar.gain * v[scalar.dof], scalar.lower, scalar.upper);
    const double work = h * tau * mean[scalar.dof];
    (static_cast<int>(i) < num_drives_ ? energy_.drives : energy_.limits) += work;
  }
  for (size_t c = 0; c < problem_.contacts.size(); ++c) {
    const ContactPoint& contact = problem_.contacts[c];
    const ContactForces& forces = solver_.forces()[c];
    for (int row = 0; row < contact.num_rows(); ++row) {
      if (forces.force[row] == 0.0) continue;
      double rate = 0.0;
      for (int i = 0; i < contact.num_dofs; ++i) {
        rate += contact.jacobian[row][i] * mean[contact.dofs[i]];
      }
      energy_.contacts += h * forces.force[row] * rate;
    }
    // Side B or A is the object, which is seen from the moving root: subtract the frame's motion.
    const Vector3d f_A = forces.force[kNormalRow] * contact.nhat_BA_W +
                         forces.force[kTangentRow1] * contact.tangent1_W +
                         forces.force[kTangentRow2] * contact.tangent2_W;
    if (contact.is_on_object) {
      energy_.contacts -= h * mean_v_WH.dot(contact.link >= 0 ? Vector3d(-f_A) : f_A);
    }
  }
}

double ImplicitWorld::CalcEnergyResidual() {
  return CalcKineticEnergy() - energy_.kinetic_at_start - energy_.drives - energy_.limits -
         energy_.gravity - energy_.contacts - energy_.external;
}

void ImplicitWorld::FindHandContacts(std::vector<HandContact>& contacts) const {
  contacts.clear();
  for (size_t c = 0; c < problem_.contacts.size(); ++c) {
    const ContactPoint& point = problem_.contacts[c];
    const ContactForces& forces = solver_.forces()[c];
    if (!point.is_on_object || point.link < 0 || forces.force[kNormalRow] <= 0.0) continue;
    const ContactRates& rates = solver_.rates()[c];
    HandContact& contact = contacts.emplace_back();
    contact.link = point.link;
    contact.p_WC = point.p_WC;
    contact.nhat_W = -point.nhat_BA_W;
    contact.normal_force = forces.force[kNormalRow];
    contact.friction_W = -forces.force[kTangentRow1] * point.tangent1_W -
                         forces.force[kTangentRow2] * point.tangent2_W;
    contact.spin_moment = forces.force[kSpinRow];
    contact.slip_speed = std::hypot(rates[kTangentRow1], rates[kTangentRow2]);
    contact.is_sliding = forces.is_at_limit;
    contact.mu = point.mu();
    contact.torsion_radius = point.material.torsion_radius;
  }
}

void ImplicitWorld::UpdateBlocks(const std::vector<bool>& link_touches_object) {
  std::vector<bool> is_near(link_blocks_.size(), false);
  for (const ContactPoint& contact : problem_.contacts) {
    if (contact.is_on_object && contact.link >= 0) is_near[contact.link] = true;
  }
  for (size_t link = 0; link < link_blocks_.size(); ++link) {
    link_blocks_[link] = link_touches_object[link] || (link_blocks_[link] && is_near[link]);
  }
}

StepReport ImplicitWorld::MakeReport(const VectorXd& v, bool converged) const {
  StepReport report;
  report.converged = converged;
  report.link_touches_object.assign(hand_->links.size(), false);
  Vector3d arm_force_W = Vector3d::Zero(), arm_moment_W = Vector3d::Zero();
  for (size_t c = 0; c < problem_.contacts.size(); ++c) {
    const ContactPoint& contact = problem_.contacts[c];
    const ContactForces& forces = solver_.forces()[c];
    const double fn = forces.force[kNormalRow];
    if (fn <= 0.0) continue;
    if (contact.link >= 0 && !contact.is_self) {
      const Vector3d f_W = fn * contact.nhat_BA_W +
                           forces.force[kTangentRow1] * contact.tangent1_W +
                           forces.force[kTangentRow2] * contact.tangent2_W;
      arm_force_W += f_W;
      arm_moment_W += (contact.p_WC - middle_.X_WH.translation()).cross(f_W) +
                      forces.force[kSpinRow] * contact.nhat_BA_W;
    }
    if (!contact.is_on_object) continue;
    if (contact.link < 0) {
      report.table_force += fn;
      continue;
    }
    report.grip_force += fn;
    report.link_touches_object[contact.link] = true;
    report.worst_contact_force = std::max(report.worst_contact_force, fn);
    report.worst_penetration =
        std::max(report.worst_penetration,
                 contact.depth - 0.5 * problem_.h * solver_.rates()[c][kNormalRow]);
  }
  report.arm_force = arm_force_W.norm();
  report.arm_moment = arm_moment_W.norm();
  report.is_finite = v.allFinite();
  return report;
}

}  // namespace graspbench
