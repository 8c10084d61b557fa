#pragma once
/** @file
The report of a benchmark session: one self-contained HTML file made from stored results alone. It
needs no network, and no script except for its 3-D views. The pictures are drawn from the trials'
snapshots. */

#include <filesystem>
#include <string>

#include "datasets/session/session_store.h"
#include "reports/sections/section.h"
#include "reports/session_views.h"

namespace graspbench {

/** Writes report/index.html in the session's folder and returns its path. Equal records give equal
bytes. If the machine cannot draw or a model is missing, the page has no pictures and says why.
@param trace  for 3-D views of selected trials; empty: none.
@throws Error(kIo) when the file cannot be written. */
std::filesystem::path WriteSessionReport(const std::filesystem::path& folder,
                                         const Session& session, const TrialTracer& trace = {});
/** As above with less memory: the session loses its plan but keeps its records. */
std::filesystem::path WriteSessionReport(const std::filesystem::path& folder, Session&& session,
                                         const TrialTracer& trace = {});

/** Makes the page from its parts, for callers with pictures of their own. */
std::string MakeSessionReport(const ReportData& data);

}  // namespace graspbench
