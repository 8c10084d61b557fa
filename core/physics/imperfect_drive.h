#pragma once
/** @file
What real drives do beside following their command. The thesis (Roethling 2007, 3.1) names it:
"hysteresis and non-linearities" of 2.5 m of hose and "sticking and sliding effects caused by return
springs" of the TUM Hand's pistons; friction of the tendons, and "inherent and variable compliance"
of the Shadow Hand's muscles. It gives no law and one number: "about 2 degrees in every joint".
The laws are the simplest textbook ones; every constant is proposed.

Hysteresis: the play operator (Krasnosel'skii and Pokrovskii 1989) between command and piston, of
width w; the load does not drive the piston back.

    z <- clamp(z, q_cmd - w/2, q_cmd + w/2)        tau = clamp(k (z - theta) - d v, +-limit)

z and theta are the means of the step's start and end (implicit_world.h).
A command that goes back and forth by more than w leads the joint around a loop exactly w wide. At
the start z is the first command.

Stick-slip: dry friction beside the drive, a bristle as those of contacts (contact.h), s its stretch
at the middle of the step:

    tau_f = clamp(-k_b (s + h v) - k_b T_b v, +-tau)     s' = s + h v, at the limit -tau_f / k_b

tau is friction_static until the bristle is at its limit; then the joint slides and tau is
friction_dynamic until it is slower than kStribeckSpeed (Stribeck 1902: friction falls with speed).
With a damped drive of stiffness k a slow command therefore waits until it leads by friction_static
/ k, and the joint jumps by ((friction_static - friction_dynamic) - d kStribeckSpeed) / k. A bristle
gives back what stretched it, never more; a falling tau only dissipates.

Yielding coupling: a coupled joint has a deviation e from where its coupling has it, held by

    tau_e = -e / c - (T_c / c) de/dt          c = coupling_compliance

so a moment tau about the joint turns it by c tau. The drive's torque acts on what is coupled, as
a linkage or tendon with a spring in its last piece. The stops of the joint hold all the same.

Stiffness is a factor on JointDrive::stiffness (a torque tau then turns the joint by tau / k) and
needs nothing here. Not modelled: creep of hoses, a load-dependent loop, tendons that slacken. */

#include "core/hand/hand.h"
#include "core/physics/step_solver.h"

namespace graspbench {

/** A joint of a drive with friction that slides slower than this sticks [rad/s]. */
inline constexpr double kStribeckSpeed = 0.05;
inline constexpr double kDriveBristleStiffness = 200.0;    ///< k_b [N m/rad]
inline constexpr double kDriveBristleDampingTime = 0.001;  ///< T_b [s]
inline constexpr double kCouplingDampingTime = 0.01;       ///< T_c [s]

/** What a drive remembers from step to step. */
struct DriveMemory {
  double piston = 0.0;         ///< z at the step's end [rad]
  double piston_before = 0.0;  ///< and at its start
  bool has_followed = false;
  double stretch = 0.0;  ///< s [rad]
  bool slides = false;
};

/** Moves z of a drive whose loop has this width to the step's end; of width 0, z is the command. */
void FollowWithHysteresis(double width, double command, DriveMemory& memory);

/** @param h  step [s]. */
ScalarForce MakeDriveFriction(const JointDrive& drive, const DriveMemory& memory, int dof,
                              double h);
/** Moves the bristle to the end of the step. @param v  speed of the joint then [rad/s]. */
void FinishDriveFriction(const ScalarForce& friction, double v, double h, DriveMemory& memory);

/** @param compliance  c > 0   @param deviation  e at the middle of the step [rad]. */
ScalarForce MakeCouplingForce(double compliance, double deviation, int dof, double h);

}  // namespace graspbench
