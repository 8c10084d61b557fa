#pragma once
/** @file
With what a hand by sensed touch presses beside its elements, from the torques of its drives.

A digit that is slow is in balance: for each of its driven joints j

    tau_j - g_j = sum_i f_i a_ij,    a_ij = nhat_i . dp_i/dq_j

with the drive's torque tau, the torque g that bears the digit itself, and the normal forces f of
its contacts i. The hand knows its posture, its own masses and, as by exact touch, where it is
touched, but no force of a contact. What elements feel is taken as they feel it, shared alike by the
contacts on them; where one reads all it can, that is the least. The contacts of a link beside its
elements press alike, with what explains the torques that are left: the least squares of

    |tau - g - sum f a|^2 + kRidge |f|^2,    f >= 0

so that of two places with one lever each has its part.

Torques are those of piston or muscle, as a sensor of pressure or tension gives them: a hand that
knows only by how much a joint misses its command is wrong by stiffness times the drive's error,
0.1 N m for the 2 degrees of the TUM Hand. Friction along the surface, dry friction of a joint and
the loop of a hose are taken for normal force. A joint at a stop says nothing, since the stop may
bear its drive. What moves fast is taken for slow, and what a digit presses on another digit is taken
for the object. */

#include <Eigen/Core>
#include <vector>

#include "core/physics/world.h"
#include "core/trial/touch_sensors.h"

namespace graspbench {

/** Torque of a joint's drive that asks for this position, within its limit [N m], [N].
@param stiffness_share  of the drive's own stiffness, in use. */
double CalcDriveTorque(const Hand& hand, const HandDynamics& dynamics, const WorldState& state,
                       int joint, double position, double stiffness_share = 1.0);

/** What the contacts put on each joint of a digit that a drive holds (num_dofs) [N m]; NaN: not
known. @param command  of the last step. */
Eigen::VectorXd CalcContactTorques(const Hand& hand, World& world, const WorldCommand& command);

/** Contacts with the normal forces that the hand takes them to have, without friction; NaN where
neither elements nor torques say anything.
@param torques  of CalcContactTorques.  @param contacts  observed last by `sensors`. */
std::vector<HandContact> EstimateContacts(const std::vector<HandContact>& contacts,
                                          const TouchSensors& sensors, const HandDynamics& dynamics,
                                          const Eigen::VectorXd& torques);

}  // namespace graspbench
