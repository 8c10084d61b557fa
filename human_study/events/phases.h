#pragma once
/** @file
The two phases of a reach: fast transport, then a low-velocity phase that begins where the hand's
deceleration gives way, often with a second rise of speed (re-acceleration).
Source: Jeannerod, J. Mot. Behav. 16 (1984) 235-254, who found it at about 75 % of movement time.

With a = dv/dt, after the largest deceleration: the first maximum of a behind which a falls again by
a tenth of the largest deceleration (and four standard deviations of its noise). Where a is positive
there, the instant is that of the lowest speed before it (a = 0); else that of the maximum itself,
where the hand decelerates least. A single minimum-jerk movement has neither: its a only rises from
its lowest to 0. */

#include "human_study/events/movement.h"

namespace graspbench {

struct MovementPhases {
  EventTime reacceleration;  ///< the low-velocity phase begins
  bool rises = false;        ///< the speed rises again
};

/** @param speed  of the wrist, filtered. Looks between the peak of speed and the movement's end. */
MovementPhases FindPhases(const ScalarCurve& speed, const Movement& movement);

}  // namespace graspbench
