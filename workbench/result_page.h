#pragma once
/** @file
The page of a result of any kind, found by what its folder holds. */

#include <filesystem>

#include "datasets/journal/sealed_store.h"
#include "datasets/session/session_store.h"
#include "reports/session_views.h"

namespace graspbench {

/** 3-D views of chosen trials in a session's page, which are carried out again for them. */
enum class PageViews { kAsBefore, kWith, kWithout };

/** Makes the page of a session or a campaign again below `place`; that of a whole result (a study,
a basin) was written with it and is taken as it is.
@returns its path from `place`.
@throws Error(kUsage) for views of anything else; Error(kNotFound) when the folder holds neither;
as LoadSession and LoadCampaign. */
std::filesystem::path WriteResultPage(const std::filesystem::path& folder,
                                      const std::filesystem::path& place, OnDamage on_damage,
                                      PageViews views = PageViews::kAsBefore);

/** Explains shortly what the page of a complete session explains unasked (FindUnexplained), and
keeps it in the folder, so that the next page costs nothing. Says so, and for how long, on the
terminal. What cannot be explained, or is stopped, is said there and leaves the page as it is. */
void ExplainUnasked(const std::filesystem::path& folder, int num_workers, OnDamage on_damage);

/** Any trial of a session carried out again, for its report. Hands and objects are loaded once for
all trials.
@throws Error when a hand or an object of the session is gone. */
TrialTracer MakeTrialTracer(const Session& session);

/** For a page that is made again: the same where the one before has 3-D views, else empty. Says on
the terminal when they cannot be kept. */
TrialTracer MakeKeptTracer(const Session& session);

/** Exports and page of a finished session in its folder, made again. @returns the page. */
std::filesystem::path WriteResults(const Session& session, const TrialTracer& trace = {});

/** Where the answer of a command is, its last lines. @param table  empty: none. */
std::string FormatPlaces(const std::filesystem::path& page,
                         const std::filesystem::path& table = {});

}  // namespace graspbench
