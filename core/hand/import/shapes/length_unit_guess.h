#pragma once
/** @file
The unit in which a description gives its lengths, judged by how far the joints of a hand are apart.

A finger's joints lie 20 to 60 mm apart. The typical distance of a description's joints (median of
those that are not zero, no unit yet) is so

    below 0.3       metres: what formats ask for, and up to the links of an arm
    0.3 to 0.8      decimetres
    0.8 to 2.5      inches; told with what centimetres would be
    2.5 to 9        centimetres; told with what inches would be
    14 to 500       millimetres
    otherwise       nobody knows: an error that asks for --unit

A slide begins anywhere along its axis, so its place gives no length to compare with: one counts
above 2.5 alone, which cannot be metres. */

#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {

/** Puts places, extents and strokes in metres, and repairs strokes (joint_limits.h); meshes keep
theirs (load_shapes.h).
@param unit  of the description [m]; 0: inferred, and reported unless it is the metre. */
void SetLengthUnit(double unit, const std::string& file, Diagnostics& problems, ForeignHand& hand);

/** By link: the distance from its joint to the farthest joint on it; at an end that of its own from
the one before; slides do not count; 0: none, a hub among them [m]. */
std::vector<double> CalcLinkLengths(const ForeignHand& hand);

}  // namespace graspbench
