#pragma once
/** @file
The frozen configuration of a folder: written once, with schema and versions, and never changed.
Sessions, scenes and campaigns each have one such file; what differs between them is a row here. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/json.h"

namespace graspbench {

struct FrozenKind {
  const char* what;     ///< "session"
  const char* file;     ///< "session.json"
  int schema;           ///< of the folder's layout and records; others are refused
  const char* command;  ///< "graspbench run": starts one
  const char* remedy;   ///< for another schema: "run the session anew into another folder"
};

bool HasFrozen(const FrozenKind& kind, const std::filesystem::path& folder);

/** The configuration as it was written.
@throws Error(kNotFound) none there; kVersion another schema; kFormat damaged; kIo. */
Json LoadFrozen(const FrozenKind& kind, const std::filesystem::path& folder);

/** Writes the file; the folder exists. @throws Error(kIo). */
void WriteFrozen(const FrozenKind& kind, const std::filesystem::path& folder, const Json& config);

/** Every difference on a line of its own, indented; empty: none. */
std::string ListDifferences(const std::vector<std::string>& differences);

}  // namespace graspbench
