#pragma once
/** @file
Which of Iberall's (1987) three oppositions a finished grasp is, found from where the forces act:

    pad    palmar surfaces of the digits press against each other
    palm   the palm bears with the digits
    side   the side of a finger bears: thumb against it, or two fingers

With N the sum of the normal forces, a contact is the palm's when its link is of no digit, and one
of a side when its normal lies within 45 degrees of the axis about which the digit's distal joint
flexes. The palm's share of N makes it palm opposition from 10 % on; else a third on sides makes it
side opposition (of thumb against a side, the side bears half); else it is pad opposition. Shares
and angle are proposed by graspbench. A link that lies against the object without pressing does not
count. */

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

/** @param X_WL  of all links.  @pre contacts, each with a force above 0. */
Opposition FindOpposition(const Hand& hand, const std::vector<Pose>& X_WL,
                          const std::vector<HandContact>& contacts);

}  // namespace graspbench
