#pragma once
/** @file
Links that stand where none can: at the open hand one link of a digit within another digit, deep in
the palm or back in its own digit, or in the air, apart from the link that carries it; collision
shapes beside the picture of their link, or of another size. Reported by name, with the distance:
the place of a joint or of a shape is wrong. What lies near a digit's first joint may be within the
palm, its housing. */

#include <string>

#include "core/base/diagnostics.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** @pre the digits are known. */
void FindMisplacedLinks(const std::string& file, const ImportedHand& imported,
                        Diagnostics& problems);

}  // namespace graspbench
