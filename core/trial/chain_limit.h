#pragma once
/** @file
The solver keeps room for contacts of links behind so many joints (ContactPoint::kMaxChain). */

#include "core/hand/hand.h"

namespace graspbench {

/** @throws Error(kUnsupported) for a hand with a longer chain of joints than the solver holds. */
void DemandShortChains(const Hand& hand);

}  // namespace graspbench
