#include "core/physics/implicit_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/error.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/** Stiffness of the stops at the joint limits and of a blocked joint [N m/rad]. */
constexpr double kLimitStiffness = 200.0;
constexpr double kSlideLimitStiffness = 1e5;  // [N/m] of a prismatic joint
/** Largest change of the speeds since the bias was computed [rad/s, m/s]. */
constexpr double kBiasSpeedTolerance = 1e-5;
/** The same for the products of speeds in the bias; 1e-8 N m for links of 1e-4 kg m^2. */
constexpr double kBiasProductTolerance = 1e-4;
/** Slower bodies are at rest [rad/s, m/s]. A contact settles within its relaxation time, so 1e-5 N
of its force are still missing then. */
constexpr double kStandingSpeed = 1e-8;
/** The hand's mass matrix is kept until a joint moves or the hand turns by this much [rad], [m] for
slides. The matrix then changes by about the same share. */
constexpr double kKeptAngle = 1e-3;
constexpr double kMostSpeed = 1e6;  // [m/s], [rad/s]

Matrix3d MakeRotation(const Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle < 1e-12) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
}

/** Removes the rounding errors of many small rotations. */
Matrix3d Orthonormalize(const Matrix3d& R) {
  return Eigen::Quaterniond(R).normalized().toRotationMatrix();
}

}  // namespace

void DemandShortChains(const Hand& hand, int num_base) {
  const HandDynamics dynamics(hand);
  const size_t most =
      std::min<size_t>(ContactPoint::kMaxChain, ContactPoint::kMaxDofs - 6 - num_base);
  for (size_t link = 0; link < hand.links.size(); ++link) {
    const std::vector<int>& chain = dynamics.chain(static_cast<int>(link));
    std::set<int> dofs;
    for (int joint : chain) {
      dynamics.ForEachSpeed(joint, [&](int dof, double) { dofs.insert(dof); });
    }
    const size_t length = std::max(chain.size(), dofs.size());
    if (length > most) {
      throw Error(ErrorKind::kUnsupported,
                  "hand \"" + hand.id + "\" has " + std::to_string(length) +
                      " joints between its root and link \"" + hand.links[link].name +
                      "\"; the simulation takes at most " + std::to_string(most) +
                      (num_base > 6 ? " on an arm with " + std::to_string(num_base) : ""));
    }
  }
}

ImplicitWorld::ImplicitWorld(const Hand& hand, const GraspObject& object, const SimConfig& config,
                             TablePresence table)
    : World(hand, object, config, table), config_(config) {
  problem_.h = config.step;
  problem_.contacts.reserve(128);
}

std::unique_ptr<World> ImplicitWorld::Clone() const {
  return std::make_unique<ImplicitWorld>(*this);
}

void ImplicitWorld::Reset(const WorldState& state) {
  ResetScene(state);
  ResetArm();
  const int n = object_dof() + 6;
  problem_.M = Eigen::MatrixXd::Zero(n, n);
  problem_.u = VectorXd::Zero(n);
  problem_.bias = VectorXd::Zero(n);
  v_ = FindSpeeds();
  commanded_v_WH_ = state.v_WH;
  problem_.contacts.clear();
  drives_.assign(static_cast<size_t>(dynamics_.num_dofs()), DriveMemory());
  step_number_ = 0;
  SetExternalLoad(Vector3d::Zero(), Vector3d::Zero());
  stands_ = false;
  solver_.Forget();
  mass_place_ = {};
  v_before_.resize(0);
  energy_ = EnergyAccount();
  energy_.kinetic_at_start = CalcKineticEnergy();
}

void ImplicitWorld::MovePositions(double h, const VectorXd& u, WorldState& state) const {
  const int base = dynamics_.num_dofs(), object = object_dof();
  for (int joint = 0; joint < dynamics_.num_joints(); ++joint) {
    state.q[joint] += h * dynamics_.rate_of_joint(joint) * u[dynamics_.dof_of_joint(joint)];
    if (const int dof = dynamics_.deviation_dof(joint); dof >= 0) {
      state.q[joint] += h * u[dof];
      state.deviation[joint] += h * u[dof];
    }
  }
  if (arm_) {
    state.q_arm += h * u.segment(base, num_base_);  // X_WH follows from the arm
  } else {
    state.X_WH.linear() = MakeRotation(h * u.segment<3>(base)) * state.X_WH.linear();
    state.X_WH.translation() += h * u.segment<3>(base + 3);
  }
  state.R_WO = MakeRotation(h * u.segment<3>(object)) * state.R_WO;
  state.p_WOcm += h * u.segment<3>(object + 3);
}

void ImplicitWorld::AddDrives(const WorldCommand& command) {
  const double h = problem_.h;
  for (int dof = 0; dof < dynamics_.num_dofs(); ++dof) {
    const int joint = dynamics_.joint_of_dof(dof), distal = dynamics_.distal_of_dof(dof);
    if (dynamics_.is_deviation(dof)) {
      problem_.scalars.push_back(MakeCouplingForce(hand_->joints[joint].coupling_compliance,
                                                   middle_.deviation[joint], dof, h));
      continue;
    }
    const JointDrive& drive = hand_->joints[joint].drive;
    DriveMemory& memory = drives_[dof];
    FollowWithHysteresis(drive.hysteresis_width, command.q[joint], memory);
    const double followed = 0.5 * (memory.piston_before + memory.piston);
    double theta = middle_.q[joint];
    if (distal >= 0 && hand_->coupling == CouplingRule::kMiddleFirst) {
      theta += middle_.q[distal] - middle_.deviation[distal];
    }
    const double limit = command.torque_limit.size() > 0
                             ? std::min(drive.torque_limit, command.torque_limit[joint])
                             : drive.torque_limit;
    const double stiffness =
        command.stiffness.size() > 0 ? command.stiffness[joint] * drive.stiffness : drive.stiffness;
    // The mean angle is that at the middle of the step plus h (v - u) / 4.
    const double mean_gain = 0.25 * stiffness * h;
    problem_.scalars.push_back({dof, stiffness * (followed - theta) + mean_gain * problem_.u[dof],
                                mean_gain + drive.damping, -limit, limit});
  }
  first_friction_ = static_cast<int>(problem_.scalars.size());
  for (int dof = 0; dof < dynamics_.num_dofs(); ++dof) {
    if (dynamics_.is_deviation(dof)) continue;
    const JointDrive& drive = hand_->joints[dynamics_.joint_of_dof(dof)].drive;
    if (drive.friction_static == 0.0) continue;
    problem_.scalars.push_back(MakeDriveFriction(drive, drives_[dof], dof, h));
  }
  num_drives_ = static_cast<int>(problem_.scalars.size());
}

/** Adds a stop on both sides, which exerts no force while the joint is between them. */
void ImplicitWorld::AddStops(int dof, double rate, double q, double lower, double upper,
                             double stiffness) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // A joint far from its limits cannot reach them within the step.
  constexpr double kNear = 0.1;
  const double gain = stiffness * problem_.h * rate * rate;
  if (q < lower + kNear) {
    problem_.scalars.push_back({dof, stiffness * rate * (lower - q), gain, 0.0, kInfinity});
  }
  if (q > upper - kNear) {
    problem_.scalars.push_back({dof, stiffness * rate * (upper - q), gain, -kInfinity, 0.0});
  }
}

void ImplicitWorld::AddLimits() {
  for (int joint = 0; joint < dynamics_.num_joints(); ++joint) {
    const HandJoint& stopped = hand_->joints[joint];
    const double stiffness = stopped.is_prismatic ? kSlideLimitStiffness : kLimitStiffness;
    const bool is_ruled = stopped.coupled_to >= 0 && !stopped.is_mimic;
    double lower = stopped.lower, upper = stopped.upper;
    if (is_ruled && hand_->coupling == CouplingRule::kMiddleFirst) {
      lower = std::max(lower, 0.0);
      // the middle joint is never bent less
      upper = std::min(upper, middle_.q[stopped.coupled_to]);
    }
    const double rate = dynamics_.rate_of_joint(joint);
    // A joint tied to another one obeys the limits of that one.
    const bool is_tied = stopped.coupled_to >= 0 &&
                         (stopped.is_mimic || hand_->coupling != CouplingRule::kMiddleFirst);
    if (rate != 0.0 && !is_tied) {
      AddStops(dynamics_.dof_of_joint(joint), rate, middle_.q[joint] - middle_.deviation[joint],
               lower, upper, stiffness);
    }
    if (const int dof = dynamics_.deviation_dof(joint); dof >= 0) {
      AddStops(dof, 1.0, middle_.q[joint], lower, upper, stiffness);
    }
  }
}

void ImplicitWorld::AddRollingResistance() {
  first_rolling_ = static_cast<int>(problem_.scalars.size());
  const double moment = config_.table_rolling_resistance * collider_.rolling_load();
  if (moment == 0.0) return;
  // One moment against the rotation, by components. A body that does not rotate yet is resisted
  // alike in both directions.
  const Eigen::Vector2d turn = state_.w_WO.head<2>();
  const double speed = turn.norm();
  for (int k = 0; k < 2; ++k) {
    const double share = speed > kRollingRestSpeed ? std::abs(turn[k]) / speed : std::sqrt(0.5);
    problem_.scalars.push_back(
        {object_dof() + k, 0.0, moment / kRollingRestSpeed, -share * moment, share * moment});
  }
}

/** Fills problem_.bias for an arm that accelerates the hand by `acceleration_W`. */
void ImplicitWorld::CalcBias(const VectorXd& mean_speeds, const Vector3d& acceleration_W) {
  const int base = dynamics_.num_dofs(), object = object_dof();
  VectorXd& bias = problem_.bias;
  if (arm_) {
    CalcArmBias(mean_speeds);
  } else {
    dynamics_.CalcBias(mean_speeds.head(object), state_.gravity_W, bias.head(object));
    const Eigen::Matrix<double, 6, 1> inertia =
        problem_.M.block<6, 3>(base, base + 3) * acceleration_W;
    carrying_ = bias.segment<6>(base) + inertia;
    bias.segment<6>(base) = -inertia;
  }
  const Vector3d w = mean_speeds.segment<3>(object);
  const Vector3d momentum = problem_.M.block<3, 3>(object, object) * w;
  bias.segment<3>(object) = w.cross(momentum) - external_moment_W_;
  bias.segment<3>(object + 3) = -mass_.mass * state_.gravity_W - external_force_W_;
}

void ImplicitWorld::UpdateHandMass() {
  bool is_kept = mass_place_.q.size() > 0 &&
                 (middle_.q - mass_place_.q).cwiseAbs().maxCoeff() < kKeptAngle &&
                 (middle_.X_WH.linear() - mass_place_.R_WH).cwiseAbs().maxCoeff() < kKeptAngle &&
                 (!arm_ || (middle_.q_arm - mass_place_.q_arm).cwiseAbs().maxCoeff() < kKeptAngle);
  for (int joint = 0; joint < dynamics_.num_joints() && is_kept; ++joint) {
    is_kept = mass_place_.rates[joint] == dynamics_.rate_of_joint(joint);
  }
  if (is_kept) return;
  if (arm_) {
    CalcArmMasses();
  } else {
    dynamics_.CalcMassMatrix(problem_.M.topLeftCorner(object_dof(), object_dof()));
    AddArmatures(problem_.M);
  }
  mass_place_ = {middle_.q, middle_.X_WH.linear(), {}, middle_.q_arm};
  for (int joint = 0; joint < dynamics_.num_joints(); ++joint) {
    mass_place_.rates.push_back(dynamics_.rate_of_joint(joint));
  }
}

void ImplicitWorld::UpdateDynamics() {
  const int object = object_dof();
  if (arm_) {
    arm_->Update(middle_.q_arm);
    middle_.X_WH = arm_->X_WH();
  }
  dynamics_.UpdatePositions(middle_.X_WH, middle_.q);
  UpdateHandMass();
  problem_.M.block<3, 3>(object, object) = middle_.R_WO * mass_.I_OOcm * middle_.R_WO.transpose();
  problem_.M.block<3, 3>(object + 3, object + 3) = mass_.mass * Matrix3d::Identity();
}

bool ImplicitWorld::IsAsBefore(const WorldCommand& command) const {
  const auto are_equal = [](const VectorXd& a, const VectorXd& b) {
    return a.size() == b.size() && a == b;
  };
  return step_number_ > 0 && command.q == last_command_.q &&
         are_equal(command.torque_limit, last_command_.torque_limit) &&
         are_equal(command.stiffness, last_command_.stiffness) &&
         command.num_steps == last_command_.num_steps &&
         command.X_WH.matrix() == last_command_.X_WH.matrix() && command.v_WH.isZero(0.0) &&
         last_command_.v_WH.isZero(0.0) && command.w_WH.isZero(0.0) &&
         last_command_.w_WH.isZero(0.0);
}

StepReport ImplicitWorld::Step(const WorldCommand& command) {
  const bool is_as_before = IsAsBefore(command);
  if (stands_ && is_as_before) return last_report_;
  const double h = command.num_steps * config_.step;
  if (h != problem_.h) {
    solver_.Forget();
    v_before_.resize(0);
  }
  problem_.h = h;
  const int dofs = dynamics_.num_dofs(), object = object_dof();
  ChooseDistalModes(command, energy_.limits);
  problem_.u = FindSpeeds();
  const bool is_followed = !arm_ || arm_->Follow(command, h);

  middle_ = state_;
  MovePositions(0.5 * h, problem_.u, middle_);
  UpdateDynamics();

  const Pose X_WO = MakePose(middle_.R_WO, middle_.p_WOcm - middle_.R_WO * mass_.p_OOcm);
  collider_.FindContacts(dynamics_, X_WO, middle_.p_WOcm, step_number_, problem_.contacts);
  problem_.scalars.clear();
  AddDrives(command);
  if (arm_) ProjectContacts();
  AddArm(command);
  AddLimits();
  AddRollingResistance();

  const Vector3d acceleration_W = (command.v_WH - commanded_v_WH_) / h;
  commanded_v_WH_ = command.v_WH;
  const VectorXd last = v_;
  // initial guess: the same change of speed as before
  if (v_before_.size() > 0) v_ += last - v_before_;
  v_before_ = last;
  VectorXd mean_speeds = 0.5 * (problem_.u + v_);
  CalcBias(mean_speeds, acceleration_W);
  const bool converged = solver_.Solve(problem_, v_, [&](const VectorXd& v) {
    const auto refreshed = 0.5 * (problem_.u + v);
    const double change = (refreshed - mean_speeds).cwiseAbs().maxCoeff();
    const double speed =
        std::max(refreshed.cwiseAbs().maxCoeff(), mean_speeds.cwiseAbs().maxCoeff());
    if (change < kBiasSpeedTolerance || change * speed < kBiasProductTolerance) return false;
    mean_speeds = refreshed;
    CalcBias(mean_speeds, acceleration_W);
    return true;
  });

  for (int i = first_friction_; i < num_drives_; ++i) {
    const int dof = problem_.scalars[i].dof;
    FinishDriveFriction(problem_.scalars[i], v_[dof], h, drives_[dof]);
  }
  FinishForces(v_);
  StepReport report = MakeReport(v_, converged);
  report.is_followed = is_followed;
  UpdateBlocks(report.link_touches_object);

  state_ = middle_;
  MovePositions(0.5 * h, v_, state_);
  state_.R_WO = Orthonormalize(state_.R_WO);
  state_.X_WH.linear() = Orthonormalize(state_.X_WH.linear());
  state_.u = v_.head(dofs);
  if (arm_) {
    state_.u_arm = v_.segment(dofs, num_base_);
    FinishArm();
  } else {
    state_.w_WH = v_.segment<3>(dofs);
    state_.v_WH = v_.segment<3>(dofs + 3);
  }
  state_.w_WO = v_.segment<3>(object);
  state_.v_WOcm = v_.segment<3>(object + 3);
  ++step_number_;
  // Above this speed, half a step would overflow, before contacts are searched again.
  report.is_finite = v_.allFinite() && v_.cwiseAbs().maxCoeff() < kMostSpeed &&
                     state_.p_WOcm.allFinite() && state_.R_WO.allFinite() && state_.q.allFinite() &&
                     state_.X_WH.matrix().allFinite();
  stands_ = converged && is_as_before && v_.cwiseAbs().maxCoeff() < kStandingSpeed &&
            problem_.u.cwiseAbs().maxCoeff() < kStandingSpeed;
  last_command_ = command;
  last_report_ = report;
  return report;
}

void ImplicitWorld::FinishForces(const VectorXd& v) {
  const double h = problem_.h;
  const VectorXd mean = 0.5 * (problem_.u + v);
  // Momentum of unit speeds along W's axes times gravity is the generalised force of the weight.
  const int base = dynamics_.num_dofs(), object = object_dof();
  if (arm_) {
    FinishArmForces(v, mean);
  } else {
    energy_.gravity +=
        h * mean.head(object).dot(problem_.M.block(0, base + 3, object, 3) * state_.gravity_W) +
        h * mass_.mass * state_.gravity_W.dot(mean.tail<3>());
    energy_.arm += h * carrying_.dot(mean.segment<6>(base));
  }
  energy_.external += h * (external_moment_W_.dot(mean.tail<6>().head<3>()) +
                           external_force_W_.dot(mean.tail<3>()));
  for (size_t i = 0; i < problem_.scalars.size(); ++i) {
    const ScalarForce& scalar = problem_.scalars[i];
    const double work = h * scalar.Calc(v[scalar.dof]) * mean[scalar.dof];
    const int index = static_cast<int>(i);
    (index < num_drives_               ? energy_.drives
     : index < num_drives_ + num_base_ ? energy_.arm
     : index < first_rolling_          ? energy_.limits
                                       : energy_.contacts) += work;
  }
  for (size_t c = 0; c < problem_.contacts.size(); ++c) {
    const ContactPoint& contact = problem_.contacts[c];
    const ContactForces& forces = solver_.forces()[c];
    if (forces.force == ContactRates()) continue;
    ContactRates rates = {0.0, 0.0, 0.0, 0.0};
    for (int i = 0; i < contact.num_dofs; ++i) {
      for (int row = 0; row < contact.num_rows(); ++row) {
        rates[row] += contact.jacobian[row][i] * mean[contact.dofs[i]];
      }
    }
    for (int row = 0; row < contact.num_rows(); ++row) {
      energy_.contacts += h * forces.force[row] * rates[row];
    }
    FinishContact(contact, rates, forces, h, step_number_);
  }
}

double ImplicitWorld::CalcEnergyResidual() {
  return CalcKineticEnergy() - energy_.kinetic_at_start - energy_.drives - energy_.limits -
         energy_.gravity - energy_.contacts - energy_.external - energy_.arm;
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
    contact.is_at_limit = forces.is_at_limit;
    contact.mu = point.mu();
    contact.mu_dynamic = point.material.friction_dynamic;
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

/** Time from first contact to the end of the step, of a contact that has a force [s]. */
double ImplicitWorld::CalcTouchAge(const ContactPoint& contact) const {
  double approach = 0.0;
  for (int i = 0; i < contact.num_dofs; ++i) {
    approach -= contact.jacobian[kNormalRow][i] * problem_.u[contact.dofs[i]];
  }
  const double h = problem_.h;
  if (approach <= 0.0) return contact.depth > 0.0 ? h : 0.0;
  return std::clamp(0.5 * h + contact.depth / approach, 0.0, h);
}

StepReport ImplicitWorld::MakeReport(const VectorXd& v, bool converged) const {
  StepReport report;
  report.converged = converged;
  report.link_touches_object.assign(hand_->links.size(), false);
  report.touch_age.assign(hand_->links.size(), 0.0);
  for (size_t c = 0; c < problem_.contacts.size(); ++c) {
    const ContactPoint& contact = problem_.contacts[c];
    const double fn = solver_.forces()[c].force[kNormalRow];
    if (fn <= 0.0 || !contact.is_on_object) continue;
    if (contact.link < 0) {
      report.table_force += fn;
      continue;
    }
    report.grip_force += fn;
    report.link_touches_object[contact.link] = true;
    report.touch_age[contact.link] =
        std::max(report.touch_age[contact.link], CalcTouchAge(contact));
    report.worst_contact_force = std::max(report.worst_contact_force, fn);
    double depth = contact.depth - 0.5 * problem_.h * solver_.rates()[c][kNormalRow];
    if (contact.surface.factor > 0.0) depth -= CalcCompression(contact, depth).surface;
    report.worst_penetration =
        std::max(report.worst_penetration, depth - contact.material.pad.depth);
  }
  VectorXd torques(num_base_);
  for (int k = 0; k < num_base_; ++k) {
    const ScalarForce& scalar = problem_.scalars[num_drives_ + k];
    torques[k] = scalar.Calc(v[scalar.dof]);
  }
  if (arm_) ReportTorques(torques, report);
  const Eigen::Matrix<double, 6, 1> arm =
      arm_ ? arm_->CalcBaseForce(torques) : Eigen::Matrix<double, 6, 1>(torques);
  report.arm_moment = arm.head<3>().norm();
  report.arm_force = arm.tail<3>().norm();
  report.is_finite = v.allFinite();
  return report;
}

}  // namespace graspbench
