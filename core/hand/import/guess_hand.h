#pragma once
/** @file
What a URDF does not say about a hand, guessed from its tree and its shapes; hand.yaml tells the
user that they are guesses.

- A digit is a chain of links from the palm outwards to an end that can touch, from the last link
  that it shares with another chain. A chain that only follows other joints, or leads the
  neighbour's, and reaches less far than that neighbour is part of its linkage.
- The pad faces where the last link goes when the digit closes (core/hand/closing.h).
- The thumb is the digit of that name, otherwise the one that faces the others most.
- The palm faces where the digits can meet (palm_frame.h). Where the fingers' pads face the same
  way, within 60 degrees of that, they say it more exactly; an axis that is within 37 degrees of
  the direction of a gripper is meant. Digits that cannot meet in front of the palm are an error. */

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** Fills digits, the palm's frame and its surface, the drives and the accuracies; puts the root
where the palm's frame is H. @param file  of the description, for messages.
@param palm_normal  out of the palm, in its frame; nothing: guessed. */
void GuessHand(const std::string& file, const std::optional<Eigen::Vector3d>& palm_normal,
               ImportedHand& imported, Diagnostics& problems);

}  // namespace graspbench
