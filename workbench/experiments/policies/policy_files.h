#pragma once
/** @file
Files that the policies of a session name: a policy.yaml and, of a shell command, each word that is
a file, as a script or its weights. Files of the system (/usr) are left out. A session keeps the
SHA-256 of each in inputs/policies.json, since trials of a controller that has changed do not belong
to those of the one before. What a file reads or imports is not followed. */

#include <filesystem>
#include <map>
#include <string>

#include "datasets/plan/session_inputs.h"

namespace graspbench {

/** Names as in the commands of the base and of all conditions, each with its SHA-256. */
std::map<std::string, std::string> FindPolicyFiles(const SessionConfig& config,
                                                   const SessionInputs& inputs);

/** Into the folder of a new session; nothing where there are none. @throws Error(kIo). */
void KeepPolicyFiles(const std::map<std::string, std::string>& files,
                     const std::filesystem::path& folder);

/** @param folder  of a session, or of an experiment in its folder.
@throws Error(kUsage) naming the files that have changed or are missing here. */
void CheckPolicyFiles(const std::filesystem::path& folder);

}  // namespace graspbench
