#pragma once
/** @file
What a URDF does not say about a hand, guessed from its tree and its shapes; hand.yaml tells the
user that they are guesses.

- A digit is a chain of links from the palm outwards to an end that can touch, from the last link
  that it shares with another chain. A chain that only follows other joints, or leads the
  neighbour's, and reaches less far than that neighbour is part of its linkage.
- The pad faces where the last link goes when the digit closes (core/hand/closing.h).
- The thumb is the digit of that name, otherwise the one that faces the others most.
- The palm faces where the fingers' pads face when they agree (thumb included when the open digits
  point away from each other), otherwise, in a gripper, along the fingers. */

#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** Fills digits, the palm's frame and its surface, the drives and the accuracies; puts the root
where the palm's frame is H. @param file  of the description, for messages. */
void GuessHand(const std::string& file, ImportedHand& imported, Diagnostics& problems);

}  // namespace graspbench
