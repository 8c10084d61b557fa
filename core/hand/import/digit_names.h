#pragma once
/** @file
What the digits of a foreign hand are called: by the names of their links and joints, then
by their place. */

#include "core/hand/hand.h"

namespace graspbench {

/** Gives each digit the id ("TH", "FF", ..) that most names of its links and joints tell; of two
digits the one that tells it more often, and neither when they are equal: "middle" may be a phalanx.
The others have none. */
void NameByVotes(Hand& hand);

/** Names the others from the thumb's side, FF, MF, RF, LF, D1, .., and puts all in the order of a
hand, the thumb last. @pre one digit is the thumb; tips are placed. */
void NameDigits(Hand& hand);

}  // namespace graspbench
