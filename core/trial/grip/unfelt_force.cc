#include "core/trial/grip/unfelt_force.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/trial/grip/grip_statics.h"

namespace graspbench {
namespace {

using Eigen::VectorXd;

constexpr double kNearStop = 1e-3;    // [rad]
constexpr int kNumSweeps = 100;       // of the least squares, enough for about three interacting
                                      // unknowns
constexpr double kRidge = 1e-6;       // [m^2]
constexpr double kLeastLever = 2e-3;  // below it the torques do not determine a force [m]

/** The contacts of one link on its elements, or those beside them. */
struct ContactGroup {
  std::vector<size_t> contacts;
  VectorXd torque = {};         // of a unit force, on joints with known torque
  double force = 0.0;           // [N]
  double least = 0.0;           // [N]
  bool follows_torques = true;  // else its elements give the force
};

/** By link; for each link, contacts beside its elements come first. */
std::map<std::pair<int, bool>, ContactGroup> GroupContacts(const std::vector<HandContact>& contacts,
                                                           const TouchSensors& sensors) {
  std::map<std::pair<int, bool>, ContactGroup> groups;
  for (size_t i = 0; i < contacts.size(); ++i) {
    groups[{contacts[i].link, sensors.is_on_elements(i)}].contacts.push_back(i);
  }
  for (auto& [key, group] : groups) {
    const auto [link, is_on_elements] = key;
    if (!is_on_elements) continue;
    group.force = group.least = sensors.CalcLinkForce(link);
    group.follows_torques = sensors.IsSaturated(link);
  }
  return groups;
}

/** Torque of a unit force that is shared equally by these contacts of a link. */
VectorXd CalcUnitTorque(const std::vector<HandContact>& contacts, const std::vector<size_t>& of,
                        const HandDynamics& dynamics) {
  std::vector<HandContact> units;
  for (const size_t i : of) {
    units.push_back(contacts[i]);
    units.back().normal_force = 1.0;
  }
  const std::vector<int> parts(static_cast<size_t>(units.front().link) + 1, 0);
  return CalcPartLoads(units, parts, 1, dynamics, -Eigen::Vector3d::UnitZ()).front().torque;
}

}  // namespace

double CalcDriveTorque(const Hand& hand, const HandDynamics& dynamics, const WorldState& state,
                       int joint, double position, double stiffness_share) {
  const JointDrive& drive = hand.joints[static_cast<size_t>(joint)].drive;
  const double error = position - CalcDrivePosition(hand, state, joint);
  const double speed = state.u[dynamics.dof_of_joint(joint)];
  return std::clamp(stiffness_share * drive.stiffness * error - drive.damping * speed,
                    -drive.torque_limit, drive.torque_limit);
}

VectorXd CalcContactTorques(const Hand& hand, World& world, const WorldCommand& command) {
  HandDynamics& dynamics = world.dynamics();
  const WorldState& state = world.state();
  VectorXd bias(dynamics.num_speeds());
  dynamics.CalcBias(VectorXd::Zero(dynamics.num_speeds()), state.gravity_W, bias);
  VectorXd torques = VectorXd::Constant(dynamics.num_dofs(), kUnset);
  for (int dof = 0; dof < dynamics.num_dofs(); ++dof) {
    const int joint = dynamics.joint_of_dof(dof);
    const int link = hand.joints[static_cast<size_t>(joint)].link;
    if (dynamics.is_deviation(dof) || hand.FindDigitOfLink(link) < 0) continue;
    const double share = command.stiffness.size() > 0 ? command.stiffness[joint] : 1.0;
    double torque = CalcDriveTorque(hand, dynamics, state, joint, command.q[joint], share);
    if (command.torque_limit.size() > 0) {
      torque = std::clamp(torque, -command.torque_limit[joint], command.torque_limit[joint]);
    }
    torques[dof] = torque - bias[dof];
  }
  for (int joint = 0; joint < hand.num_joints(); ++joint) {
    const HandJoint& one = hand.joints[static_cast<size_t>(joint)];
    const double q = state.q[joint];
    const bool is_at_stop = q < one.lower + kNearStop || q > one.upper - kNearStop;
    if (is_at_stop && dynamics.rate_of_joint(joint) != 0.0) {
      torques[dynamics.dof_of_joint(joint)] = kUnset;
    }
  }
  return torques;
}

std::vector<HandContact> EstimateContacts(const std::vector<HandContact>& contacts,
                                          const TouchSensors& sensors, const HandDynamics& dynamics,
                                          const VectorXd& torques) {
  auto groups = GroupContacts(contacts, sensors);
  VectorXd left = torques;
  for (auto& [key, group] : groups) {
    group.torque =
        torques.array().isNaN().select(0.0, CalcUnitTorque(contacts, group.contacts, dynamics));
    if (group.follows_torques && group.torque.norm() < kLeastLever) {
      group.follows_torques = false;
      if (!key.second) group.force = kUnset;
      continue;
    }
    left -= group.force * group.torque;
  }
  left = left.array().isNaN().select(0.0, left);
  for (int sweep = 0; sweep < kNumSweeps; ++sweep) {
    for (auto& [key, group] : groups) {
      if (!group.follows_torques) continue;
      const double change =
          (group.torque.dot(left) - kRidge * group.force) / (group.torque.squaredNorm() + kRidge);
      const double force = std::max(group.least, group.force + change);
      left -= (force - group.force) * group.torque;
      group.force = force;
    }
  }
  std::vector<HandContact> estimated = contacts;
  for (const auto& [key, group] : groups) {
    for (const size_t i : group.contacts) {
      estimated[i].normal_force = group.force / static_cast<double>(group.contacts.size());
      estimated[i].friction_W.setZero();
    }
  }
  return estimated;
}

}  // namespace graspbench
