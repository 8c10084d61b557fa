#pragma once
/** @file
Where the real recordings lie: $GRASPBENCH_DATA/mocap, else shared/data/mocap beside the checkout.
They are not part of the project; tests that need them say so when they are absent. */

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "core/base/files.h"

namespace graspbench {

inline std::filesystem::path FindMocapData() {
  namespace fs = std::filesystem;
  const char* root = std::getenv("GRASPBENCH_DATA");
  const fs::path data = root != nullptr && *root != '\0'
                            ? fs::path(root)
                            : FindDataRoot().parent_path() / "shared" / "data";
  return data / "mocap";
}

}  // namespace graspbench

/** Defines `variable` as a recording's path, or skips the test with the place looked at. */
#define GRASPBENCH_REQUIRE_MOCAP(variable, relative)                                 \
  const std::filesystem::path variable = ::graspbench::FindMocapData() / (relative); \
  if (!std::filesystem::exists(variable))                                            \
  GTEST_SKIP() << "no recording at " << variable << "; GRASPBENCH_DATA names the folder"
