#pragma once
/** @file
profile.yaml: how somebody judges grasps (core/trial/protocols/free_space_profile.h), with sources.
Those that come with the program are the files of datasets/profiles, `<name>.yaml` each. */

#include <string>
#include <vector>

#include "core/base/file_keys.h"
#include "core/trial/protocols/free_space_profile.h"

namespace graspbench {

/** The keys of profile.yaml, in the order of the fields. */
const FileKeys& ListProfileKeys();

/** @param file  its name in messages.
@throws Error(kFormat) listing every key that is unknown, out of range or no word it takes. */
FreeSpaceProfile ParseProfile(const std::string& text, const std::string& file);

/** Of the profiles that come with the program, sorted by name.
@throws as ParseProfile; Error(kIo). */
std::vector<FreeSpaceProfile> ListProfiles();

/** @param name_or_path  a shipped one's name, or a file. @throws Error(kNotFound) with suggestions;
as ParseProfile. */
FreeSpaceProfile LoadProfile(const std::string& name_or_path);

/** @throws as LoadProfile; Error(kUsage) when two have one name. */
std::vector<FreeSpaceProfile> LoadProfiles(const std::vector<std::string>& names_or_paths);

}  // namespace graspbench
