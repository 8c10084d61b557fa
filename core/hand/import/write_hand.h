#pragma once
/** @file
An imported hand as files of the project's own form. */

#include <map>
#include <string>

#include "core/base/diagnostics.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

/** Name below the hand's folder -> content: hand.urdf, hand.yaml with a comment for every guess,
README.md with what was repaired, meshes/. @param source  name of the description, without folder.
@param problems  of the import: the README lists them. */
std::map<std::string, std::string> FormatHandFiles(const ImportedHand& imported,
                                                   const std::string& source,
                                                   const Diagnostics& problems);

}  // namespace graspbench
