#pragma once
/** @file
What two folders of one result must share whoever ran it and however often it was stopped: every
byte but journals, run.json, what workers and progress say, and the manifests that name these. */

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "tests/support/run_program.h"

namespace graspbench {

/** From the folder, sorted. */
inline std::vector<std::filesystem::path> ListResults(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::filesystem::path path = entry.path(), in = path.parent_path();
    const bool is_of_a_run = in.filename() == "journal" || in.filename() == "judge" ||
                             in.filename() == "workers" || in.filename() == "progress" ||
                             in.filename() == "logs" ||
                             path.filename().string().rfind("run.json", 0) == 0;  // or a part of it
    const bool is_store = std::filesystem::exists(in / "session.json") ||
                          std::filesystem::exists(in / "scene.json") ||
                          std::filesystem::exists(in / "development.json");
    if (!entry.is_regular_file() || is_of_a_run) continue;
    if (is_store && path.filename() == "manifest.json") continue;
    files.push_back(path.lexically_relative(folder));
  }
  std::sort(files.begin(), files.end());
  return files;
}

inline void ExpectSameResults(const std::filesystem::path& a, const std::filesystem::path& b) {
  const std::vector<std::filesystem::path> files = ListResults(a);
  EXPECT_GT(files.size(), 2u) << a;
  EXPECT_EQ(ListResults(b), files);
  for (const std::filesystem::path& file : files) ExpectSameFile(a / file, b / file);
}

}  // namespace graspbench
