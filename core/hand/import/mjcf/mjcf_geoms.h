#pragma once
/** @file
The extent of a geom of a MuJoCo model, and what of it weighs. */

#include <optional>
#include <string>

#include "core/hand/import/foreign_hand.h"
#include "core/hand/import/mjcf/mjcf_document.h"

namespace graspbench {

/** By `size`, for the kind that `shape` has. False: it has no good one. */
bool ReadGeomExtent(MjcfDocument& document, const MjcfNode& node, const std::string& where,
                    ForeignShape& shape);
/** The same by `fromto`, which also says its place in the body. */
bool ReadGeomFromTo(MjcfDocument& document, const MjcfNode& node, const std::string& where,
                    ForeignShape& shape);

/** `mass`, else `density`; nothing when it weighs nothing, or when the compiler takes no inertia
from it. */
std::optional<ForeignShape::Weight> FindGeomWeight(MjcfDocument& document, const MjcfNode& node,
                                                   const std::string& where);

}  // namespace graspbench
