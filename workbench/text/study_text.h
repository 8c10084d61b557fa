#pragma once
/** @file
What a human study found, for the terminal. */

#include <filesystem>
#include <string>

#include "core/base/text/json.h"
#include "human_study/study/run/run_study.h"
#include "human_study/study/suggest/suggest_settings.h"
#include "human_study/study/synthetic/demo_study.h"

namespace graspbench {

/** A line for each reason by which trials were removed, with the keys that would change it; first
that none is left, if so. */
std::string FormatRemoved(const StudyResult& result);

/** Each setting with why, what it costs and how many trials count then; what none mends. */
std::string FormatSuggestions(const StudySuggestions& suggestions);

/** A line for each warning about the study as a whole. */
std::string FormatWarnings(const StudyResult& result);

/** What a run says: whether the choices are the frozen ones, what was removed, warnings, and of what
counts the detection limit of the GFT, how reliable the opening and how simultaneous people are. */
std::string FormatStudy(const StudyResult& result, const std::filesystem::path& folder,
                        const std::filesystem::path& report);

/** How many trials count and why others do not, and where the rest is. */
Json MakeStudyJson(const StudyResult& result, const std::filesystem::path& folder,
                   const std::filesystem::path& report);

/** Found minus true times of a synthetic study. */
std::string FormatTruth(const TruthComparison& comparison);

}  // namespace graspbench
