#pragma once
/** @file
A hand as it is seen and as it touches, beside each other. */

#include <memory>
#include <string>

#include "core/hand/hand.h"
#include "core/render/scene.h"

namespace graspbench {

/** Three columns: the pictures of its links, pictures and contact shapes through each other, the
contact shapes alone (core/render/contact_shapes.h). Two rows: against the palm, and from the side.
All joints at zero, or at the limit nearest to it. @throws Error(kEnvironment) when the machine
cannot draw. */
Image DrawHandShapes(const std::shared_ptr<const Hand>& hand);

/** What its columns and colours are, a line. */
std::string DescribeHandShapes();

}  // namespace graspbench
