#pragma once
/** @file
The report page of a result; its kind follows from the content of the folder. */

#include <filesystem>

#include "datasets/journal/sealed_store.h"
#include "datasets/session/session_store.h"
#include "reports/session_views.h"

namespace graspbench {

/** Whether a session's page has 3-D views of selected trials, for which these are simulated
again. */
enum class PageViews { kAsBefore, kWith, kWithout };

/** Rebuilds the page of a session, a campaign or judged grasps below `place`. The page of a whole
result (a study, a basin) was written with it and is copied as it is.
@returns its path relative to `place`.
@throws Error(kUsage) for 3-D views of anything but a session; Error(kNotFound) when the folder
holds no result with a page; as LoadSession and LoadCampaign. */
std::filesystem::path WriteResultPage(const std::filesystem::path& folder,
                                      const std::filesystem::path& place, OnDamage on_damage,
                                      PageViews views = PageViews::kAsBefore);

/** Runs the short explanations that the page of a complete session shows by default
(FindUnexplained). They are kept in the folder, so the next page reuses them. Announces the
estimated time on the terminal. If it fails or is stopped, says so there; the page then shows the
explanations found so far. */
void ExplainUnasked(const std::filesystem::path& folder, int num_workers, OnDamage on_damage);

/** Returns a function that simulates any trial of the session again for its report. Hands and
objects are loaded once for all trials.
@throws Error when a hand or an object of the session is missing. */
TrialTracer MakeTrialTracer(const Session& session);

/** As MakeTrialTracer if the session's existing page has 3-D views, else empty. Prints a message
when the views cannot be rebuilt. */
TrialTracer MakeKeptTracer(const Session& session);

/** Writes the exports and the page of a finished session into its folder. @returns the page. */
std::filesystem::path WriteResults(const Session& session, const TrialTracer& trace = {});

/** Formats the last lines of a command's output: the paths of its results. @param table  empty:
none. */
std::string FormatPlaces(const std::filesystem::path& page,
                         const std::filesystem::path& table = {});

}  // namespace graspbench
