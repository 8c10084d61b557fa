#pragma once
/** @file
Results of a human study, as text for the terminal. */

#include <filesystem>
#include <string>

#include "core/base/text/json.h"
#include "human_study/study/run/run_study.h"
#include "human_study/study/suggest/suggest_settings.h"
#include "human_study/study/synthetic/demo_study.h"

namespace graspbench {

/** One line per removal reason, with the keys that would change it. Begins with a notice if no
trial is left. */
std::string FormatRemoved(const StudyResult& result);

/** Each suggested setting with its reason, its cost and the number of trials then included; then
the removals that no setting avoids. */
std::string FormatSuggestions(const StudySuggestions& suggestions);

/** Warnings about the whole study, one line each; at most three of a kind. */
std::string FormatWarnings(const StudyResult& result);

/** Summary of a run: whether the choices are the frozen ones, removals and warnings; for the
included trials the detection limit of GFT, the reliability of the opening, and the simultaneity of
contacts. */
std::string FormatStudy(const StudyResult& result, const std::filesystem::path& folder,
                        const std::filesystem::path& report);

/** Numbers of included and removed trials, the removal reasons, and the paths of further
results. */
Json MakeStudyJson(const StudyResult& result, const std::filesystem::path& folder,
                   const std::filesystem::path& report);

/** Differences found - true of the event times in a synthetic study. */
std::string FormatTruth(const TruthComparison& comparison);

}  // namespace graspbench
