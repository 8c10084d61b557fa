#pragma once
/** @file
Digits that close away from all others: their axes or limits are reversed, or they grasp from
within. */

#include <vector>

#include "core/hand/hand.h"

namespace graspbench {

/** By digit. While the others stand open, or closed by a quarter, all of the digit's joints close to
0.4 of their ranges. If its pad recedes from one of theirs and comes nearer to none by a fifth of
that, or 1 mm, it closes outward. @pre digits with tips and pads. */
std::vector<bool> FindOutwardDigits(const Hand& hand);

}  // namespace graspbench
