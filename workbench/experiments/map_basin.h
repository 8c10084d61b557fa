#pragma once
/** @file
The robustness basin of one grasp, sampled (core/trial/basin.h): a session of one cell whose draws
are the points of a Halton sequence, and what it says as basin.csv and a page. */

#include <atomic>
#include <filesystem>
#include <string>

#include "core/trial/basin.h"
#include "workbench/experiments/run_session.h"

namespace graspbench {

struct BasinRequest {
  std::string hand, object;
  std::string grasp = "best";
  int num_samples = 200;
  std::filesystem::path out;
  bool replace = false;  ///< another basin there, unchanged since it was written
};

/** Makes the session in `out`, or finds it there. @throws Error(kUsage) when the request names more
than one grasp, or for a folder that holds something else; Error(kNotFound, kFormat) for the hand,
the object or the grasp; as PrepareSession. */
PreparedSession PrepareBasin(const BasinRequest& request);

}  // namespace graspbench
