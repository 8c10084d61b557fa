#pragma once
/** @file
Links that are only looked at: drawn axes, a mount, a cover.

A link with a picture alone is decoration where a link that it is fixed to, directly or by others,
has collision shapes: then the description says what of that body touches. A body without any
collision shape touches with its pictures (load_shapes.h). */

#include <string>

#include "core/base/diagnostics.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {

/** Marks such links (ForeignLink::is_decoration) and reports each. */
void FindDecoration(const std::string& file, Diagnostics& problems, ForeignHand& hand);

}  // namespace graspbench
