#pragma once
/** @file
A folder of a test's own, which stays where it is when the test has failed. */

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace graspbench {

class TestFolder {
 public:
  explicit TestFolder(const std::string& name)
      : path_(std::filesystem::path(testing::TempDir()) /
              (name + "_" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TestFolder() {
    std::error_code status;
    if (!testing::Test::HasFailure()) std::filesystem::remove_all(path_, status);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace graspbench
