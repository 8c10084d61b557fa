#pragma once
/** @file
profile.yaml: rules by which grasps are judged (core/trial/protocols/free_space_profile.h), with
sources. The shipped profiles are the files `<name>.yaml` in datasets/profiles. */

#include <string>
#include <vector>

#include "core/base/file_keys.h"
#include "core/trial/protocols/free_space_profile.h"

namespace graspbench {

/** The keys of profile.yaml, in the order of the fields. */
const FileKeys& ListProfileKeys();

/** @param file  its name in messages.
@throws Error(kFormat) listing every key that is unknown or has an invalid value. */
FreeSpaceProfile ParseProfile(const std::string& text, const std::string& file);

/** Lists the shipped profiles, sorted by name.
@throws as ParseProfile; Error(kIo). */
std::vector<FreeSpaceProfile> ListProfiles();

/** @param name_or_path  the name of a shipped profile, or a file. @throws Error(kNotFound) with
suggestions; as ParseProfile. */
FreeSpaceProfile LoadProfile(const std::string& name_or_path);

/** @throws as LoadProfile; Error(kUsage) when two have the same name. */
std::vector<FreeSpaceProfile> LoadProfiles(const std::vector<std::string>& names_or_paths);

}  // namespace graspbench
