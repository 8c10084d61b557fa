#include "core/trial/measures/load_recorder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/trial/grip/grip_statics.h"

namespace graspbench {
namespace {

constexpr double kInterval = 0.01;      // of samples [s]
constexpr double kTableFriction = 1.0;  // upper bound for all tables here
/** Share of a torque limit: what a drive at its limit holds creeps, and so does its torque. */
constexpr double kShareOfLimit = 0.9;
constexpr double kStopWidth = 1e-3;  // [rad], [m]

}  // namespace

LoadRecorder::LoadRecorder(const TrialSetup& setup, const std::vector<int>& digits)
    : hand_(setup.hand),
      way_(setup.grasp.q_target - setup.grasp.q_pre),
      part_of_link_(MapLinksToParts(*setup.hand, digits)) {
  for (const int digit : digits) {
    joints_.emplace_back();
    for (const int link : hand_->digits[static_cast<size_t>(digit)].links) {
      const int joint = hand_->links[static_cast<size_t>(link)].joint;
      if (joint >= 0 && way_[joint] != 0.0) joints_.back().push_back(joint);
    }
  }
  normal_work_.resize(joints_.size() + 1);
  friction_work_.resize(joints_.size() + 1);
}

void LoadRecorder::AddWork(double duration, const World& world,
                           const std::vector<HandContact>& contacts) {
  const WorldState& state = world.state();
  const Eigen::Vector3d w_HO_W = state.w_WO - state.w_WH;
  // Velocity of Ocm relative to the point of H at its position.
  const Eigen::Vector3d v_W =
      state.v_WOcm - state.v_WH - state.w_WH.cross(state.p_WOcm - state.X_WH.translation());
  for (const HandContact& contact : contacts) {
    const auto part = static_cast<size_t>(part_of_link_[static_cast<size_t>(contact.link)]);
    const Eigen::Vector3d way_W = duration * (v_W + w_HO_W.cross(contact.p_WC - state.p_WOcm));
    normal_work_[part] += contact.normal_force * contact.nhat_W.dot(way_W);
    friction_work_[part] += contact.friction_W.dot(way_W);
  }
  gravity_work_ += duration * world.mass_properties().mass * state.gravity_W.dot(v_W);
}

/** Returns the joint of a part whose drive is at its torque limit; -1: none. A drive that is
limited to a share of its torque could exert more, and one at a joint stop does not press on the
object. */
int LoadRecorder::FindFullDrive(size_t part, const World& world,
                                const WorldCommand& command) const {
  for (const int joint : joints_[part]) {
    const HandJoint& one = hand_->joints[static_cast<size_t>(joint)];
    const double limit = one.drive.torque_limit;
    if (!(limit > 0.0)) continue;
    if (command.torque_limit.size() > 0 && command.torque_limit[joint] < kShareOfLimit * limit)
      continue;
    const double share = command.stiffness.size() > 0 ? command.stiffness[joint] : 1.0;
    const double torque = share * one.drive.stiffness *
                          (command.q[joint] - CalcDrivePosition(*hand_, world.state(), joint));
    if (std::abs(torque) < kShareOfLimit * limit) continue;
    const double q = world.state().q[joint];
    if (torque > 0.0 ? q < one.upper - kStopWidth : q > one.lower + kStopWidth) return joint;
  }
  return -1;
}

void LoadRecorder::Observe(double time, double duration, const World& world,
                           const WorldCommand& command, const StepReport& report,
                           const std::vector<HandContact>& contacts) {
  const WorldState& state = world.state();
  if (std::isnan(begun_)) {
    begun_ = time;
    v_begun_W_ = state.v_WOcm;
    rest_W_ = state.p_WOcm.head<2>();
    return;
  }
  for (const HandContact& contact : contacts) {
    impulse_W_ += duration * (contact.normal_force * contact.nhat_W + contact.friction_W);
  }
  table_impulse_ += duration * report.table_force;
  AddWork(duration, world, contacts);
  const double length = time - begun_;
  if (length < kInterval - 1e-9) return;

  LoadSample sample;
  sample.time = time;
  sample.shift = (state.p_WOcm.head<2>() - rest_W_).norm();
  sample.R_HO = (state.X_WH.linear().transpose() * state.R_WO).cast<float>();
  sample.gravity_work = std::exchange(gravity_work_, 0.0);
  const double mass = world.mass_properties().mass;
  const Eigen::Vector3d rest =
      (mass * (state.v_WOcm - v_begun_W_) - impulse_W_) / length - mass * state.gravity_W;
  const double table = table_impulse_ / length;
  sample.table_force = table;
  has_touched_ = has_touched_ || !impulse_W_.isZero();
  const Eigen::Vector2d v_W = state.v_WOcm.head<2>();
  const double along = has_touched_ ? rest.head<2>().norm() - kTableFriction * table
                                    : rest.head<2>().dot(v_W.stableNormalized());
  sample.push = std::max(0.0, along) + std::abs(rest.z() - table);

  sample.parts.resize(joints_.size() + 1);
  for (const HandContact& contact : contacts) {
    PartSample& part =
        sample.parts[static_cast<size_t>(part_of_link_[static_cast<size_t>(contact.link)])];
    part.force += static_cast<float>(contact.normal_force);
    part.normal_W += (contact.normal_force * contact.nhat_W).cast<float>();
  }
  for (size_t at = 0; at < sample.parts.size(); ++at) {
    PartSample& part = sample.parts[at];
    part.normal_work = static_cast<float>(std::exchange(normal_work_[at], 0.0));
    part.friction_work = static_cast<float>(std::exchange(friction_work_[at], 0.0));
    if (at >= joints_.size()) continue;
    const int full = FindFullDrive(at, world, command);
    part.is_at_limit = full >= 0;
    if (full >= 0) part.limit_joint = hand_->joints[static_cast<size_t>(full)].name;
  }
  samples_.push_back(std::move(sample));
  begun_ = time;
  v_begun_W_ = state.v_WOcm;
  impulse_W_.setZero();
  table_impulse_ = 0.0;
}

}  // namespace graspbench
