#pragma once
/** @file
ro-crate-metadata.json of a session's folder: its contents and provenance (which program run made
which file from which), for archives that do not know graspbench.

Source: RO-Crate 1.1, https://w3id.org/ro/crate/1.1, and its profile Process Run Crate 0.5,
https://w3id.org/ro/wfrun/process/0.5. It contains the times in run.json, so like that file it
differs between runs of the same session. It names no host. */

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/journal/manifest.h"

namespace graspbench {

/** Formats the metadata. @pre the session was exported. @throws Error(kNotFound) without run.json
or its export; Error(kFormat) when one of them is damaged; Error(kIo). */
std::string FormatRoCrate(const std::filesystem::path& folder);

/** Origin of a file made by `command` of this program: version, commit, versions of physics and
judge. */
ManifestOrigin MakeOrigin(const std::string& command);

/** Origin of an output of the store in `folder`, with the command that reproduces it there, as
"graspbench export .". @param only  sources of the store to list (manifest.h); empty: all.
@throws Error(kIo). */
ManifestOrigin MakeOutputOrigin(const std::filesystem::path& folder, const std::string& command,
                                const std::vector<std::string>& only = {});

}  // namespace graspbench
