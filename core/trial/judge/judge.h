#pragma once
/** @file
The judge of grasps: the external load that a held object resists.

From the end of the hold, with gravity as it is, the object is pulled at its centre of mass along
the six half axes of the palm's frame, and twisted about them, each time again, with a load that
grows as

    L(t) = m g (exp(t / tau) - 1),   tau = 0.3 s,

slowly for weak grasps and within seconds for strong ones. The grasp is broken when the object has
moved by 20 mm or turned by 30 degrees in the palm's frame, or the hand has let go of it. The
breaking load is the largest part of the load that the hand balanced until then, over 20 ms:

    resisted = mean(L) - (P(t) - P(t - 20 ms)) / 20 ms,

P the object's momentum along the load. So the inertia of the object, which delays its flight while
the load grows on, does not count for the hand. Moments are grown as L times the object's radius.
The range ends at 100 N (100 N times the radius): a grasp that stands that is recorded unbroken. */

#include "core/quality/wrench_space.h"
#include "core/trial/judge/held_object.h"
#include "core/trial/judge/judgement.h"

namespace graspbench {

/** @param direction_W  unit vector. */
BreakingLoad FindBreakingForce(const HeldObject& held, const Eigen::Vector3d& direction_W);

/** The smallest of the breaking forces along the six half axes of the palm's frame [N]: the
breaking_force of JudgeGrasp for a third of its cost, since a pull ends as soon as the hand has
balanced more of it than of the weakest before. */
double FindWeakestForce(const HeldObject& held);

/** All tests of a grasp: breaking loads, epsilons of every convention, verdicts.
@param contacts  those of the moment, positions from the centre of mass, axes of O. */
Judgement JudgeGrasp(const HeldObject& held, const std::vector<GraspContact>& contacts);

}  // namespace graspbench
