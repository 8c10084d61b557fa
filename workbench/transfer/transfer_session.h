#pragma once
/** @file
A session of human grasps on robot hands. Every included trial, or the median of each person on each
object, is transferred to every hand (core/transfer). On request it is there a second time, with the
course of the person's reach (core/transfer/play_person.h). The session runs these grasps on its
draws, along with the hand's best standard grasp and the rehearsed one. Its folder is a session like
any other, so it is stopped, continued, judged, verified and reported like one.
inputs/grasps/transfer.json states what each transfer preserved
(datasets/analysis/transfer_summary.h). */

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/analysis/transfer_summary.h"
#include "workbench/experiments/run_session.h"

namespace graspbench {

struct TransferRequest {
  std::string study, data;  ///< study.yaml; folder of the recordings, empty: that of study.yaml
  SessionConfig config;     ///< hands, trials, seed
  bool takes_every_trial = false;  ///< else the medians by person and object
  bool plays = false;              ///< each grasp along the person's course, too
  std::filesystem::path out;
  int num_workers = 1;
};

/** Transfers the grasps, and creates the folder or finds it with the same grasps.
@throws Error(kUsage) for a folder with other grasps; as LoadStudyGrasps, LoadStudyObject,
LoadSessionInputs, RehearseGrasps. */
PreparedSession PrepareTransfers(const TransferRequest& request);

}  // namespace graspbench
