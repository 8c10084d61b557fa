#pragma once
/** @file
Covers every link of a digit: what its contact shapes leave out of the description's surface gets
balls of its own (cover_surface.h), which objects and the table meet (CollisionShape::is_cover). */

#include <string>

#include "core/base/diagnostics.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** Notes how much was added, and warns of a link of which more than 1.5 mm stays uncovered at 95 of
100 points. @param num_points  on a link. @pre the digits are known. */
void CoverLinks(const std::string& file, int num_points, ImportedHand& imported,
                Diagnostics& problems);

}  // namespace graspbench
