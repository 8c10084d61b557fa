#pragma once
/** @file
How much of what friction and grip allow a grasp uses, so that nobody asks a search for more:

    bound = mu_s N - m g      [N]

with N the sum of the hand's normal forces in the hold and m g the object's weight: pulled straight
down, contacts whose normals are horizontal resist with friction alone, at most mu_s times their
normal force each, of which the weight has its part. The weakest of the six pulls (learning_trial.h)
of a grasp by an object's sides is no larger, whichever digits press how much (Coulomb). At
equal grip no other grasp by the sides gets more than 1 / share of what this one has.

Blind to: a hand that reaches beneath the object or around a bar, which may have a share above 1;
digits that press harder when the object is pushed into them; moments and pulls along the fingers,
which may end a grasp earlier. */

#include <vector>

#include "core/optimise/learning_trial.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

/** At least 0. @param normal_force  N [N].  @param weight  m g [N]. */
double CalcFrictionBound(double normal_force, double friction, double weight);

struct Headroom {
  double bound = 0.0;  ///< mean over the trials that held [N]; NaN: none did
  /** Mean strength (sigma where it was not asked for) of the trials that held, over the bound. */
  double share = 0.0;
};
/** By what factor a grasp by the sides may be stronger at equal grip: 1 / share, at least 1. */
double CalcMostGain(double share);

/** @param gravity  [m/s^2] */
Headroom CalcHeadroom(const std::vector<LearningTrial>& trials, const GraspObject& object,
                      double gravity);

}  // namespace graspbench
