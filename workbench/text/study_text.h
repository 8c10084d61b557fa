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

/** Whether the choices are the frozen ones, a line for each that is not; empty without a freeze. */
std::string FormatFreeze(const Study& study);

/** A line for each reason by which trials were removed, with the keys that would change it; first
that none is left, if so. */
std::string FormatRemoved(const StudyResult& result);

/** Each setting with why, what it costs and how many trials count then; what none mends. */
std::string FormatSuggestions(const StudySuggestions& suggestions);

/** A line for each warning about the study as a whole. */
std::string FormatWarnings(const StudyResult& result);

/** Detection limit of the GFT; empty when no trial says. */
std::string FormatZeroGft(const ZeroGft& zero);

/** Whether the hand opening is more reliable than the aperture; empty when no trial counts. */
std::string FormatOpeningArgument(const StudyResult& result);

/** Whether people are more simultaneous than independent digits; empty when no trial counts. */
std::string FormatIndependence(const StudyResult& result);

/** All of the above that a run says, and where the rest is. */
std::string FormatStudy(const StudyResult& result, const std::filesystem::path& folder,
                        const std::filesystem::path& report);

/** How many trials count and why others do not, and where the rest is. */
Json MakeStudyJson(const StudyResult& result, const std::filesystem::path& folder,
                   const std::filesystem::path& report);

/** Found minus true times of a made-up study. */
std::string FormatTruth(const TruthComparison& comparison);

}  // namespace graspbench
