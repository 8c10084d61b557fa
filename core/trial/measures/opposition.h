#pragma once
/** @file
Which of Iberall's (1987) three oppositions a finished grasp uses, from the points of application of
its forces:

    pad    palmar surfaces of the digits press against each other
    palm   the palm bears load with the digits
    side   the side of a finger bears load: against the thumb, or between two fingers

Let N be the sum of the normal forces. A contact belongs to the palm if its link belongs to no
digit. It belongs to a side if its normal is within 45 degrees of the axis about which the digit's
distal joint flexes. It is palm opposition if the palm bears at least 10 % of N, otherwise side
opposition if sides bear at least a third, otherwise pad opposition. With the thumb against a side,
the side bears half. Shares and angle are proposed by graspbench. A link that touches the object
without pressing does not count. */

#include <vector>

#include "core/base/enum_table.h"
#include "core/base/text/json.h"
#include "core/hand/hand.h"
#include "core/physics/world.h"

namespace graspbench {

enum class Opposition { kPad, kPalm, kSide };
inline constexpr NamedValue<Opposition> kOppositions[] = {
    {Opposition::kPad, "pad"}, {Opposition::kPalm, "palm"}, {Opposition::kSide, "side"}};

inline Json ToJson(Opposition opposition) { return RowOf(kOppositions, opposition).name; }
/** @throws Error(kFormat). */
inline void ReadJson(const Json& json, Opposition& opposition) {
  opposition = RowFromName(kOppositions, json.get<std::string>(), "opposition").value;
}

/** @param X_WL  by link.  @pre there is a contact, and each has a force above 0. */
Opposition FindOpposition(const Hand& hand, const std::vector<Pose>& X_WL,
                          const std::vector<HandContact>& contacts);

}  // namespace graspbench
