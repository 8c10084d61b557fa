#pragma once
/** @file
What wrong inputs end in, and inputs in a folder that lasts as long as its test. */

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "core/base/error.h"
#include "core/base/files/files.h"

namespace graspbench {

/** Message of the Error that a call throws; empty when it throws none. */
inline std::string FaultOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

inline void ExpectHolds(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" is missing in:\n" << text;
}

/** A folder of the running test alone. */
class FolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const ::testing::TestInfo& test = *::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) /
              (std::string(test.test_suite_name()) + "_" + test.name());
    std::filesystem::remove_all(folder_);
    MakeFolder(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void Write(const std::string& name, const std::string& text) const {
    WriteFileAtomically(folder_ / name, text);
  }
  void Append(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::app) << text;
  }
  std::string Read(const std::string& name) const { return ReadFile(folder_ / name); }

  std::filesystem::path folder_;
};

}  // namespace graspbench
