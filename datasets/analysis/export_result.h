#pragma once
/** @file
Writes the derived files of a finished session's folder, depending on the kind of session. */

#include <filesystem>

#include "datasets/session/session_store.h"

namespace graspbench {

/** Calls ExportSession. For a session with conditions, also writes export/effects.csv and
conditions.csv with their dictionaries (sweep_summary.h). Where grip thresholds are known, writes
export/thresholds.csv (threshold_summary.h); for a basin, basin.csv in the session's folder. @throws
Error(kIo). */
void ExportResult(const std::filesystem::path& folder, const Session& session,
                  bool with_records = false);

}  // namespace graspbench
