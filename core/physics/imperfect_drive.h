#pragma once
/** @file
Imperfections of real drives. For the TUM Hand the thesis (Roethling 2007, 3.1) mentions "hysteresis
and non-linearities" of 2.5 m of hose and "sticking and sliding effects caused by return springs" of
its pistons. For the Shadow Hand it mentions friction of the tendons and "inherent and variable
compliance" of the muscles. It gives no law and one number: "about 2 degrees in every joint". The
laws are the simplest textbook ones; every constant is proposed.

Hysteresis: the play operator (Krasnosel'skii and Pokrovskii 1989) of width w between command and
piston. The load does not drive the piston back.

    z <- clamp(z, q_cmd - w/2, q_cmd + w/2)        tau = clamp(k (z - theta) - d v, +-limit)

z and theta are the means of the step's start and end (implicit_world.h). A command that oscillates
by more than w drives the joint around a loop of width w. Initially z is the first command.

Stick-slip: dry friction parallel to the drive, a bristle like those of contacts (contact.h). s is
its stretch at the middle of the step:

    tau_f = clamp(-k_b (s + h v) - k_b T_b v, +-tau)     s' = s + h v, at the limit -tau_f / k_b

tau is friction_static until the bristle reaches its limit. Then the joint slides and tau is
friction_dynamic until the joint is slower than kStribeckSpeed (Stribeck 1902: friction falls with
speed). So with a damped drive of stiffness k, a joint under a slow command waits until the command
leads by friction_static / k. Then it jumps by ((friction_static - friction_dynamic) - d
kStribeckSpeed) / k. A bristle returns the energy that stretched it, never more; a falling tau only
dissipates.

Compliant coupling: a coupled joint has a deviation e from the position that its coupling
prescribes, subject to

    tau_e = -e / c - (T_c / c) de/dt          c = coupling_compliance

so a moment tau about the joint turns it by c tau. The drive's torque acts on the coupled position,
as in a linkage or tendon with a spring in its last segment. The joint's stops remain effective.

Stiffness is a factor on JointDrive::stiffness (a torque tau then turns the joint by tau / k) and
needs no law here. Not modelled: creep of hoses, a load-dependent loop, slack tendons. */

#include "core/hand/hand.h"
#include "core/physics/step_solver.h"

namespace graspbench {

/** Below this speed a sliding joint with drive friction sticks [rad/s]. */
inline constexpr double kStribeckSpeed = 0.05;
inline constexpr double kDriveBristleStiffness = 200.0;    ///< k_b [N m/rad]
inline constexpr double kDriveBristleDampingTime = 0.001;  ///< T_b [s]
inline constexpr double kCouplingDampingTime = 0.01;       ///< T_c [s]

/** State of a drive between steps. */
struct DriveMemory {
  double piston = 0.0;         ///< z at the step's end [rad]
  double piston_before = 0.0;  ///< z at its start [rad]
  bool has_followed = false;
  double stretch = 0.0;  ///< s [rad]
  bool slides = false;
};

/** Moves z of a drive with hysteresis of this width to the step's end; for width 0, z is the
command. */
void FollowWithHysteresis(double width, double command, DriveMemory& memory);

/** Makes the force of a drive's friction. @param h  step [s]. */
ScalarForce MakeDriveFriction(const JointDrive& drive, const DriveMemory& memory, int dof,
                              double h);
/** Moves the bristle to the end of the step. @param v  joint speed at that time [rad/s]. */
void FinishDriveFriction(const ScalarForce& friction, double v, double h, DriveMemory& memory);

/** Makes the force of a compliant coupling.
@param compliance  c > 0   @param deviation  e at the middle of the step [rad]. */
ScalarForce MakeCouplingForce(double compliance, double deviation, int dof, double h);

}  // namespace graspbench
