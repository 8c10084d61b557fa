#pragma once
/** @file
The page of a result of any kind, found by what its folder holds. */

#include <filesystem>

#include "datasets/journal/sealed_store.h"

namespace graspbench {

/** 3-D views of chosen trials in a session's page, which are carried out again for them. */
enum class PageViews { kAsBefore, kWith, kWithout };

/** Makes the page of a session or a campaign again below `place`; that of a whole result (a study, a
basin) was written with it and is taken as it is.
@returns its path from `place`.
@throws Error(kUsage) for views of anything else; Error(kNotFound) when the folder holds neither;
as LoadSession and LoadCampaign. */
std::filesystem::path WriteResultPage(const std::filesystem::path& folder,
                                      const std::filesystem::path& place, OnDamage on_damage,
                                      PageViews views = PageViews::kAsBefore);

}  // namespace graspbench
