#pragma once
/** @file The page of a result of any kind, found by what its folder holds. */

#include <filesystem>

#include "datasets/journal/sealed_store.h"

namespace graspbench {

/** Makes the page of a session or a campaign anew below `place`; that of a whole result (a study, a
basin) was written with it and is taken as it is.
@param with_views  a session's page has 3-D views of chosen trials, which are carried out again.
@returns its path from `place`.
@throws Error(kUsage) for views of anything else; Error(kNotFound) when the folder holds neither;
as LoadSession and LoadCampaign. */
std::filesystem::path WriteResultPage(const std::filesystem::path& folder,
                                      const std::filesystem::path& place, OnDamage on_damage,
                                      bool with_views = false);

}  // namespace graspbench
