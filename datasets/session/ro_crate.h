#pragma once
/** @file
ro-crate-metadata.json of a session's folder: what is in it, and which runs of which program made
what from what, for archives that know nothing of graspbench.

Source: RO-Crate 1.1, https://w3id.org/ro/crate/1.1, and its profile Process Run Crate 0.5,
https://w3id.org/ro/wfrun/process/0.5. It holds the clock of run.json and is therefore, as that file,
not the same for the same session. Of a host it says nothing. */

#include <filesystem>
#include <string>

namespace graspbench {

/** @pre the session was exported. @throws Error(kNotFound) without run.json or its export;
Error(kFormat) when one of them is damaged; Error(kIo). */
std::string FormatRoCrate(const std::filesystem::path& folder);

}  // namespace graspbench
