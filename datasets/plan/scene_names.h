#pragma once
/** @file
Hands, objects and grasps by the names that people call them: "TUM", "light bulb", "power". Names
become ids before anything else sees them, so that results do not depend on how they were given. */

#include <string>
#include <vector>

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

/** Each object of a list by itself: "all" among others is the catalogue's ids, a folder of objects'
folders is each of them, by name. "all" alone stays. */
std::vector<std::string> ExpandObjects(const std::vector<std::string>& names);

/** Does so in all lists of names, and lists objects one by one. */
void ReplaceNames(SessionConfig& config);

/** "29 objects: 21 of the catalogue, 8 of the folder scans", by the folders that hold the folders of
objects. */
std::string DescribeObjectNames(const std::vector<std::string>& names);

}  // namespace graspbench
