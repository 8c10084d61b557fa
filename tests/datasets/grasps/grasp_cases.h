#pragma once
/** @file
The files that the readers of foreign grasps are tried on; tests/fuzz replays them too. */

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/grasps/grasp_files.h"

namespace graspbench {

inline std::string FindGraspCase(const std::string& format, const std::string& name) {
  return (FindDataRoot() / "tests" / "fuzz" / "cases" / ("grasps_" + format) / name).string();
}

inline std::vector<ForeignGrasp> ReadGraspCase(const std::string& format, const std::string& name,
                                               const GraspReadOptions& options = {}) {
  return ReadGrasps(FindGraspCase(format, name), "auto", options);
}

/** What the error says that an action throws; empty: it throws none. */
template <class Action>
std::string FindGraspError(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace graspbench
