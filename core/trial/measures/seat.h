#pragma once
/** @file
Where an object sits in the hand. Some things have two stable places in one grasp: a ball stays at
the fingertips or is squeezed up between the bent fingers, and grips of the two differ by three to
four times. So grip force, sigma and contact times have one value per seat.

A trial is "reseated" when the object rose by more than kReseatedRise between the first touch and
the end of stabilisation: closing digits centre a thing along the table, but what rises was squeezed
out of where they met it. A success is "caged" when less normal force holds it than kCagedForce or
kCagedWeights times its weight, whichever is less: two contacts with friction 0.8 need 1.25 weights
between them to hold by friction alone, so what is held by a few weights or less may lie in the
fingers rather than be held by them. Both limits are proposed by graspbench. */

#include "core/trial/trial_result.h"

namespace graspbench {

inline constexpr double kReseatedRise = 0.005;  ///< [m]
inline constexpr double kCagedForce = 1.5;      ///< [N]
inline constexpr double kCagedWeights = 5.0;

enum class Seat {
  kUnknown,   ///< the trial ended before lift-off, or its record is older than physics 10
  kKept,      ///< where the digits met it
  kReseated,  ///< squeezed up to another place
};

Seat FindSeat(const TrialResult& result);
const char* NameOf(Seat seat);  ///< "kept", "reseated"; "" of an unknown one

/** A success that holds with so little force; false where the weight is not recorded. */
bool IsCaged(const TrialResult& result);

}  // namespace graspbench
