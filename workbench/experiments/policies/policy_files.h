#pragma once
/** @file
Files named by the policies of a session: a policy.yaml, and each word of a shell command that is a
file, such as a script or its weights. System files (/usr) are left out. A session stores the
SHA-256 of each file in inputs/policies.json, since trials of a changed controller must not be mixed
with earlier ones. Files that a file reads or imports are not followed. */

#include <filesystem>
#include <map>
#include <string>

#include "datasets/plan/session_inputs.h"

namespace graspbench {

/** Returns file names, as in the commands of the base and of all conditions, with their SHA-256. */
std::map<std::string, std::string> FindPolicyFiles(const SessionConfig& config,
                                                   const SessionInputs& inputs);

/** Stores the hashes in the folder of a new session; does nothing without files.
@throws Error(kIo). */
void KeepPolicyFiles(const std::map<std::string, std::string>& files,
                     const std::filesystem::path& folder);

/** @param folder  of a session, or of an experiment in its folder.
@throws Error(kUsage) naming the files that have changed or are missing. */
void CheckPolicyFiles(const std::filesystem::path& folder);

}  // namespace graspbench
