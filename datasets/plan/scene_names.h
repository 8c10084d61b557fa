#pragma once
/** @file
Hands, objects and grasps by the names that people call them: "TUM", "light bulb", "power". Names
become ids before anything else sees them, so that results do not depend on how they were given. */

#include <string>

#include "datasets/plan/session_config.h"

namespace graspbench {

/** A name as it is compared: lower-case, blanks and hyphens as underscores. */
std::string MakeComparable(const std::string& name);

/** The id of what comes with the program, for its id or name in any case; what is none of them, a
path perhaps, as it is. A file or folder goes before a name. */
///@{
std::string FindHandId(const std::string& given);
std::string FindObjectId(const std::string& given);
std::string FindGraspId(const std::string& given);
///@}

/** Does so in all lists of names. */
void ReplaceNames(SessionConfig& config);

}  // namespace graspbench
