#pragma once
/** @file
Reads an arm from `arm.yaml` in a folder of its own; `graspbench help arm.yaml` lists the keys. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/arm/arm.h"
#include "core/base/error.h"
#include "core/base/file_keys.h"

namespace graspbench {

/** Ids of the arms that come with the program: the folders of core/arm/models, sorted. */
std::vector<std::string> ListArms();

/** @param id_or_folder  a known id, or the path of a folder with arm.yaml.
@throws Error(kNotFound) with suggestions; Error(kFormat) listing every problem with file and line.
*/
Arm LoadArm(const std::string& id_or_folder);

/** From the text of arm.yaml. @param folder  names the arm. The arm is usable only when `problems`
holds no error. */
Arm ParseArm(const std::string& text, const std::filesystem::path& folder, Diagnostics& problems);

/** The keys of arm.yaml. */
const FileKeys& ListArmKeys();

}  // namespace graspbench
