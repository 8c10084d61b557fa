#pragma once
/** @file
The files that the readers of foreign grasps are tried on; tests/fuzz replays them too. */

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/base/files/files.h"
#include "datasets/grasps/grasp_files.h"
#include "tests/datasets/find_error.h"

namespace graspbench {

inline std::string FindGraspCase(const std::string& format, const std::string& name) {
  return (FindDataRoot() / "tests" / "fuzz" / "cases" / ("grasps_" + format) / name).string();
}

inline std::vector<ForeignGrasp> ReadGraspCase(const std::string& format, const std::string& name,
                                               const GraspReadOptions& options = {}) {
  return ReadGrasps(FindGraspCase(format, name), "auto", options);
}

}  // namespace graspbench
