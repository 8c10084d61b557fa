#pragma once
/** @file
The report of a benchmark session: one self-contained HTML file made from stored results alone. */

#include <filesystem>
#include <string>

#include "datasets/session_store.h"

namespace graspbench {

/** Writes report/index.html in the session's folder and returns its path. Same records, same bytes.
 */
std::filesystem::path WriteSessionReport(const std::filesystem::path& folder,
                                         const Session& session);

}  // namespace graspbench
