#pragma once
/** @file
People's grasps on robot hands as a session: every kept trial, or the median of each person on each
object, transferred to every hand (core/transfer) and tried on the session's draws beside the
hand's best standard grasp and the rehearsed one. The folder is a session like any other, so it is
stopped, continued, judged, verified and reported like one; inputs/grasps/transfer.json says of
every grasp what was kept (datasets/analysis/transfer_summary.h). */

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/analysis/transfer_summary.h"
#include "workbench/experiments/run_session.h"

namespace graspbench {

struct TransferRequest {
  std::string study, data;         ///< study.yaml; folder of the recordings, empty: its own
  SessionConfig config;            ///< hands, trials, seed
  bool takes_every_trial = false;  ///< else medians by person and object
  std::filesystem::path out;
  int num_workers = 1;
};

/** Transfers, and makes the folder, or finds it there with the same grasps.
@throws Error(kUsage) for a folder with other grasps; as LoadStudyGrasps, LoadStudyObject,
LoadSessionInputs, RehearseGrasps. */
PreparedSession PrepareTransfers(const TransferRequest& request);

}  // namespace graspbench
