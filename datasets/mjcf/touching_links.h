#pragma once
/** @file
Which links of a hand are built so that they touch, and are therefore no contact. */

#include <set>
#include <utility>

#include "core/hand/hand.h"

namespace graspbench {

/** Pairs of links, the smaller index first, of different digits or of a digit and the palm, whose
capsules touch with all joints at zero: balls along the axis of one against the axis of the other, a
64th of its length apart. */
std::set<std::pair<int, int>> FindLinksTouchingAtRest(const Hand& hand);

}  // namespace graspbench
