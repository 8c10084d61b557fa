#pragma once
/** @file
The limits of a foreign joint and the unit of its lengths, repaired where they cannot be meant. */

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {

struct StatedLimits {
  std::string missing;              ///< what is not there, "range"; empty: they are stated
  double lower = 0.0, upper = 0.0;  ///< [rad], [m]
};

/** Fills a joint's limits; reversed ones are exchanged. Missing or equal ones and those beyond one
turn set `no_limits`, and half a turn each way for the time being, of a slide nothing.
@returns what was repaired, to stand behind the joint's name; empty: nothing. */
std::string SetLimits(const StatedLimits& stated, ForeignJoint& joint);

/** Joints without limits: one that follows another gets what the other's limits say, the rest are
fixed where they are, or at the one position that their limits allow. Each is reported. Call when
all couplings are known. */
void FixUnlimited(const std::string& file, Diagnostics& problems, ForeignHand& hand);

/** The ranges of a description's hinges, as they stand in it. */
struct StatedAngles {
  int num_joints = 0, num_beyond_turn = 0;
  int first_line = 0;
  double largest = 0.0;

  /** @param unit  in which they are read [rad]. */
  void Add(double lower, double upper, double unit, int line);
  /** What looks like another unit than the one they are read in; empty: nothing. Degrees within one
  radian's turn leave a finger a few degrees. */
  std::string FindDoubt(bool in_degrees) const;
};

/** Of a slide whose lengths are in metres: none yet, and those beyond 1 m, become 0 to 50 mm.
@returns as SetLimits. */
std::string FinishStroke(ForeignJoint& joint);

/** The unit in which a description gives its lengths, judged by how far the joints of a hand are
apart.

A finger's joints lie 20 to 60 mm apart. The typical distance of a description's joints (median of
those that are not zero, no unit yet) is so

    below 0.3       metres: what formats ask for, and up to the links of an arm
    0.3 to 0.8      decimetres
    0.8 to 2.5      inches; told with what centimetres would be
    2.5 to 9        centimetres; told with what inches would be
    14 to 500       millimetres
    otherwise       nobody knows: an error that asks for --unit

A slide begins anywhere along its axis, so its place gives no length to compare with: one counts
above 2.5 alone, which cannot be metres.

Puts places, extents and strokes in metres, and repairs strokes (FinishStroke); meshes keep
theirs (load_shapes.h).
@param unit  of the description [m]; 0: inferred, and reported unless it is the metre. */
void SetLengthUnit(double unit, const std::string& file, Diagnostics& problems, ForeignHand& hand);

/** By link: the distance from its joint to the farthest joint on it; at an end that of its own from
the one before; slides do not count; 0: none, a hub among them [m]. */
std::vector<double> CalcLinkLengths(const ForeignHand& hand);

}  // namespace graspbench
