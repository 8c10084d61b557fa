#pragma once
/** @file
The report of a benchmark session: one self-contained HTML file made from stored results alone. It
needs no network, and no script but for its 3-D views; the pictures are drawn from the trials'
snapshots. */

#include <filesystem>
#include <string>

#include "datasets/session/session_store.h"
#include "reports/sections/section.h"
#include "reports/session_views.h"

namespace graspbench {

/** Writes report/index.html in the session's folder and returns its path. Same records, same bytes.
A machine that cannot draw, or a model that is gone, costs the pictures and not the report: the page
says what is missing and why.
@param trace  gives the page 3-D views of chosen trials; empty: none.
@throws Error(kIo) when the file cannot be written. */
std::filesystem::path WriteSessionReport(const std::filesystem::path& folder,
                                         const Session& session, const TrialTracer& trace = {});
/** The same in less memory: the session loses its plan on the way, but keeps its records. */
std::filesystem::path WriteSessionReport(const std::filesystem::path& folder, Session&& session,
                                         const TrialTracer& trace = {});

/** The page from its parts, for those who bring their own pictures. */
std::string MakeSessionReport(const ReportData& data);

}  // namespace graspbench
