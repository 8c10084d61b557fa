#pragma once
/** @file
Estimates the force of contacts beside the tactile elements from the torques of the drives.

A slowly moving digit is in equilibrium. For each of its driven joints j

    tau_j - g_j = sum_i f_i a_ij,    a_ij = nhat_i . dp_i/dq_j

where tau is the drive's torque, g the torque that bears the digit's own weight, and f are the
normal forces of its contacts i. The hand knows its posture, its own masses and, as with exact
touch, the positions of its contacts, but not their forces. Forces on elements are taken as their
readings and shared equally by the contacts on them; a saturated reading is a lower bound. The
contacts of a link beside its elements share a force equally that explains the remaining torques. It
minimises

    |tau - g - sum f a|^2 + kRidge |f|^2,    f >= 0

so that two positions with the same lever share the force.

The torques are those of a piston or muscle, as measured by a pressure or tension sensor. A hand
that knows only its position error would be wrong by stiffness times the drive's error: 0.1 N m for
the 2 degrees of the TUM Hand. Friction along the surface, dry friction of a joint and hysteresis of
a hose are attributed to the normal force. A joint at its stop gives no information, since the stop
may bear the drive's torque. Fast motion is treated as slow, and forces between digits are
attributed to the object. */

#include <Eigen/Core>
#include <vector>

#include "core/physics/world.h"
#include "core/trial/touch_sensors.h"

namespace graspbench {

/** Torque of a joint's drive with this setpoint, within its limit [N m], [N].
@param stiffness_share  share of the drive's own stiffness that is in use. */
double CalcDriveTorque(const Hand& hand, const HandDynamics& dynamics, const WorldState& state,
                       int joint, double position, double stiffness_share = 1.0);

/** Torque that the contacts exert on each driven joint of a digit (num_dofs) [N m]; NaN: unknown.
@param command  of the last step. */
Eigen::VectorXd CalcContactTorques(const Hand& hand, World& world, const WorldCommand& command);

/** Returns the contacts with their estimated normal forces, without friction; NaN where neither
elements nor torques determine a force.
@param torques  from CalcContactTorques.  @param contacts  those last observed by `sensors`. */
std::vector<HandContact> EstimateContacts(const std::vector<HandContact>& contacts,
                                          const TouchSensors& sensors, const HandDynamics& dynamics,
                                          const Eigen::VectorXd& torques);

}  // namespace graspbench
