#pragma once
/** @file
Where the real recordings lie: the folder mocap of the shared data.
They are not part of the project; tests that need them say so when they are absent. */

#include <gtest/gtest.h>

#include "tests/support/shared_data.h"

namespace graspbench {

inline std::filesystem::path FindMocapData() { return FindSharedData() / "mocap"; }

}  // namespace graspbench

/** Defines `variable` as a recording's path, or skips the test with the place looked at. */
#define GRASPBENCH_REQUIRE_MOCAP(variable, relative)                                 \
  const std::filesystem::path variable = ::graspbench::FindMocapData() / (relative); \
  if (!std::filesystem::exists(variable))                                            \
  GTEST_SKIP() << "no recording at " << variable << "; GRASPBENCH_DATA names the folder"
