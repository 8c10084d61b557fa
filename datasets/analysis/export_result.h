#pragma once
/** @file
What a finished session's folder holds beside its journals, by what kind of session it
is. */

#include <filesystem>

#include "datasets/session/session_store.h"

namespace graspbench {

/** ExportSession; of a session with conditions also export/effects.csv and conditions.csv with their
dictionaries (sweep_summary.h); where grip thresholds are known export/thresholds.csv
(threshold_summary.h); of a basin basin.csv in its folder. @throws Error(kIo). */
void ExportResult(const std::filesystem::path& folder, const Session& session,
                  bool with_records = false);

}  // namespace graspbench
