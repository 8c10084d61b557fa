#pragma once
/** @file
Develops the standard grasps of a hand (core/develop) in a folder that becomes a new hand:

    hand.urdf, meshes/     copied
    hand.yaml              with a new section `grasps`, once all grasps are developed
    development/           the record of the development: a store of its own
                           (datasets/scene/development_store.h)

Repeating a request continues a stopped development. */

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "core/develop/develop_grasp.h"
#include "workbench/experiments/observer.h"
#include "workbench/experiments/pool/batch_runner.h"

namespace graspbench {

struct DevelopHandRequest {
  std::string hand;  ///< id or folder
  std::filesystem::path out;
  DevelopConfig config;
  int num_workers = 1;
  double trial_time_limit = kTrialTimeLimit;  ///< [s]
};

/** Develops the grasps. @throws Error(kUsage) when the hand has too few digits, or when the folder
holds another development or anything else, or lies in the hand's folder; Error(kInterrupted); as
LoadHand. */
std::vector<DevelopedGrasp> DevelopHand(const DevelopHandRequest& request, Observer& observer);

}  // namespace graspbench
