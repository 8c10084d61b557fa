#pragma once
/** @file
Which program has made something, and from what. */

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/journal/manifest.h"

namespace graspbench {

/** This program: version, commit, versions of physics and judge. */
ManifestOrigin MakeOrigin(const std::string& command);

/** Of an output of the store in `folder`, made by a command that can be given again there, as
"graspbench export .". @param only  of the store's sources (store_sources.h); empty: all.
@throws Error(kIo). */
ManifestOrigin MakeOutputOrigin(const std::filesystem::path& folder, const std::string& command,
                                const std::vector<std::string>& only = {});

}  // namespace graspbench
