#pragma once
/** @file
ro-crate-metadata.json of a session's folder: what is in it, and which runs of which program made
what from what, for archives that know nothing of graspbench.

Source: RO-Crate 1.1, https://w3id.org/ro/crate/1.1, and its profile Process Run Crate 0.5,
https://w3id.org/ro/wfrun/process/0.5. It holds the clock of run.json and is therefore, as that file,
not the same for the same session. Of a host it says nothing. */

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/journal/manifest.h"

namespace graspbench {

/** @pre the session was exported. @throws Error(kNotFound) without run.json or its export;
Error(kFormat) when one of them is damaged; Error(kIo). */
std::string FormatRoCrate(const std::filesystem::path& folder);

/** Which program has made something, and from what.

This program: version, commit, versions of physics and judge. */
ManifestOrigin MakeOrigin(const std::string& command);

/** Of an output of the store in `folder`, made by a command that can be given again there, as
"graspbench export .". @param only  of the store's sources (manifest.h); empty: all.
@throws Error(kIo). */
ManifestOrigin MakeOutputOrigin(const std::filesystem::path& folder, const std::string& command,
                                const std::vector<std::string>& only = {});

}  // namespace graspbench
