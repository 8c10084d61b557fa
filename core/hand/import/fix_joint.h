#pragma once
/** @file
A foreign joint held for good. */

#include "core/hand/import/foreign_hand.h"

namespace graspbench {

/** Puts a joint at a position [rad], [m] for good; those that follow it, too. */
void FixJoint(ForeignHand& hand, int index, double q);

}  // namespace graspbench
