#pragma once
/** @file
Joints that follow another, eliminated from the equations.

A linkage (HandJoint::is_mimic) ties a joint to any other by a line, q = offset + ratio q_other, and
there is no more to it. The rest of this file is about fingers whose distal joint follows the middle
one.

One drive moves a finger's middle joint J2 and its distal joint J1 together; its coordinate is
theta.

    rule            angles                     (dJ2, dJ1) / dtheta
    even            J1 = J2 = theta            (1, 1)
    fixed           J2 = theta, J1 = r J2      (1, r), r = 0.8
    middle-first    J1 + J2 = theta            (1, 0) or (0, 1)

Under middle-first J2 moves while it can; when it is blocked (by an object at the middle or proximal
phalanx, or at its upper limit) J1 moves instead. Opening undoes J1 first. Always J2 >= J1 >= 0.

So at every instant the finger has one degree of freedom here, u_J = T_J dtheta/dt, and T_J is
constant within a step. A posture names J2 only; theta of a posture is that angle, J1 starts at zero
under middle-first and at its coupled value otherwise. */

#include <Eigen/Core>

#include "core/hand/hand.h"

namespace graspbench {

/** Which joint a middle-first pair moves in this step. */
enum class DistalMode { kMiddleMoves, kDistalMoves };

struct DistalRates {
  double middle = 1.0;  ///< dJ2 / dtheta
  double distal = 0.0;  ///< dJ1 / dtheta
};
DistalRates CalcDistalRates(CouplingRule rule, double fixed_ratio, DistalMode mode);

/** @param closing  the drive pushes towards closing.
@param middle_is_blocked  an object holds the middle or proximal phalanx back. */
DistalMode FindDistalMode(double q_middle, double q_distal, double middle_upper, bool closing,
                          bool middle_is_blocked, DistalMode previous);

/** Fills the coupled joints of q from those they follow, for a posture with nothing touching. */
void ApplyCoupling(const Hand& hand, Eigen::VectorXd& q);

}  // namespace graspbench
