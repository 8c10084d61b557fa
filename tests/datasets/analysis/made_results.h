#pragma once
/** @file
Small sessions and a campaign made of known numbers. */

#include <string>
#include <vector>

#include "datasets/analysis/campaign/campaign_summary.h"
#include "datasets/analysis/conditions/basin_summary.h"

namespace graspbench {

/** A finished trial of thumb and two fingers that touch at 0.4, 0.5 and 0.6 s plus 0.01 s for every
trial, so that GCT = 0.6 + 0.01 k, GFT = 0.2 and GOT = 0.1. */
TrialRecord MakeRecord(const PlannedTrial& plan, Outcome outcome);

/** Every hand on every object with one grasp; every trial a success. */
Session MakeSession(const std::vector<std::string>& hands, const std::vector<std::string>& objects,
                    const std::string& grasp, int trials);

/** 12 cells of two trials; sigma ranks like the breaking force, epsilon against it. */
Session MakeJudgedSession();

/** Two scenes of ten trials. Sigma is 1, 2, 3 for the three variants, plus 0.01 per trial; GFT% is
40, 20, 10 %; on the can the new target grasp fails in six trials. */
Campaign MakeCampaign();

/** Those of a basin's first draws, not tried. */
std::vector<BasinSample> MakeBasinSamples(int count);

struct Summarised {
  explicit Summarised(Campaign the_campaign)
      : campaign(std::move(the_campaign)),
        benchmark(SummariseSession(campaign.benchmark)),
        scenes(ListScenes(campaign, benchmark)) {}
  Campaign campaign;
  SessionSummary benchmark;
  std::vector<SceneVariants> scenes;
};

}  // namespace graspbench
