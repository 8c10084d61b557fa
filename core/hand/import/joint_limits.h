#pragma once
/** @file The limits of a foreign joint, repaired where they cannot be meant. */

#include <string>

#include "core/hand/import/foreign_hand.h"

namespace graspbench {

struct StatedLimits {
  std::string missing;              ///< what is not there, "range"; empty: they are stated
  double lower = 0.0, upper = 0.0;  ///< [rad], [m]
};

/** Fills a joint's limits: missing or equal ones and those beyond one turn are taken as half a turn
each way, of a slide as nothing yet; reversed ones are exchanged.
@returns what was repaired, to stand behind the joint's name; empty: nothing. */
std::string SetLimits(const StatedLimits& stated, ForeignJoint& joint);

/** Of a slide whose lengths are in metres: none yet, and those beyond 1 m, become 0 to 50 mm.
@returns as SetLimits. */
std::string FinishStroke(ForeignJoint& joint);

}  // namespace graspbench
