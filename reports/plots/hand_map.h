#pragma once
/** @file
A hand seen from its palm's side, its tactile elements as discs of their area. */

#include <vector>

#include "core/hand/hand.h"
#include "reports/plots/svg_parts.h"

namespace graspbench {

/** Shaded by force, with the number where it is pointed at. All joints at zero, thumb and fingers as
they then lie; a disc is narrower the more its element faces sideways.
@param force  of each element of the hand's skin [N]. */
Html DrawHandMap(const Hand& hand, const std::vector<double>& force, const PlotText& text);

}  // namespace graspbench
