#pragma once
/** @file
Develops the standard grasps of a hand (core/develop) in a folder that becomes a hand of its own:

    hand.urdf, meshes/     as they were
    hand.yaml              with the section `grasps` made again, when all grasps are developed
    development/           how they came to be: a store of its own (datasets/scene/
                           development_store.h)

The same request again continues what was stopped. */

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "core/develop/develop_grasp.h"
#include "workbench/experiments/observer.h"
#include "workbench/experiments/pool/batch_runner.h"

namespace graspbench {

struct DevelopHandRequest {
  std::string hand;  ///< by id or folder
  std::filesystem::path out;
  DevelopConfig config;
  int num_workers = 1;
  double trial_time_limit = kTrialTimeLimit;  ///< [s]
};

/** @throws Error(kUsage) when the hand has too few digits, or the folder holds another development
or anything else, or lies in that of the hand; Error(kInterrupted); as LoadHand. */
std::vector<DevelopedGrasp> DevelopHand(const DevelopHandRequest& request, Observer& observer);

}  // namespace graspbench
