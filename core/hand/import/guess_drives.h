#pragma once
/** @file
The drives of an imported hand: what is published where a finger's drive can have it, else a guess.

An effort is taken unless more than three drives have the same 10, 100 or 1000, as exporters write
it where nobody knows, or it is more than 100 N at the tip of the longest digit, of a gripper 250
N, or of a slide more than 1 kN for each kilogram of the hand. Stiffness and damping of a position
drive are taken where they hold a finger without letting it swing or crawl. What is not taken is
reported, and so is an effort that does not bear half of the weight of what its joint moves. */

#include <string>

#include "core/base/diagnostics.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** @pre the digits are known. */
void GuessDrives(const std::string& file, ImportedHand& imported, Diagnostics& problems);

}  // namespace graspbench
