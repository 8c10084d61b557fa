#pragma once
/** @file
The limits of a foreign joint, repaired where they cannot be meant. */

#include <string>

#include "core/base/diagnostics.h"
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

}  // namespace graspbench
