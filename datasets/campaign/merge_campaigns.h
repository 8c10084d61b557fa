#pragma once
/** @file
The parts of one campaign, or of one optimisation, from several folders, where machines share no
disk. */

#include <filesystem>
#include <vector>

namespace graspbench {

/** Takes what the optimisation in `folder` lacks of those in `others`. The same questions have the
same answers, so one journal must be the beginning of the other, and the longer one is taken, with
the result when there is one. Nothing is written unless all of it fits.
@returns how many answers were new. @throws Error(kUsage) for one of other settings or another
physics; Error(kFormat) for damage, and when the answers differ; as LoadScene; Error(kIo). */
int MergeScenes(const std::filesystem::path& folder,
                const std::vector<std::filesystem::path>& others);

/** The same for the scenes and the compared searches of a campaign, and lines of its workers. The
benchmark is a session and has its own merge (merge_sessions.h). */
int MergeCampaigns(const std::filesystem::path& folder,
                   const std::vector<std::filesystem::path>& others);

}  // namespace graspbench
