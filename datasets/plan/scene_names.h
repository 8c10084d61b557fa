#pragma once
/** @file
Resolves everyday names of hands, objects and grasps: "TUM", "light bulb", "power". Names are
replaced by ids before any other use, so results do not depend on how they were given. */

#include <string>
#include <vector>

#include "datasets/plan/session_config.h"

namespace graspbench {

/** Returns the name in the form used for comparison: lower case, with underscores for blanks and
hyphens. */
std::string MakeComparable(const std::string& name);

/** Returns the id of a shipped hand, object or grasp for its id or name in any case. Returns other
text, such as a path, unchanged. An existing file or folder takes precedence over a name. */
///@{
std::string FindHandId(const std::string& given);
std::string FindObjectId(const std::string& given);
std::string FindGraspId(const std::string& given);
///@}

/** Expands a list to single objects: "all" among others becomes the catalogue's ids, and a folder
of object folders becomes these folders, sorted by name. "all" alone stays. */
std::vector<std::string> ExpandObjects(const std::vector<std::string>& names);

/** Replaces the names in all lists of the configuration by ids and expands the objects. */
void ReplaceNames(SessionConfig& config);

/** Formats the values of a list option of a command, "tum,shadow"; `placeholder` if one is a path,
because results hold no paths. */
std::string FormatListOption(const std::vector<std::string>& values,
                             const std::string& placeholder);

/** Returns "29 objects: 21 of the catalogue, 8 of the folder scans", counted by the folder that
holds the object folders. */
std::string DescribeObjectNames(const std::vector<std::string>& names);

}  // namespace graspbench
