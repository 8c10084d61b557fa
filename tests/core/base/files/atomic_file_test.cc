#include "core/base/files/atomic_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/files/files.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

class AtomicFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("atomic_files_") +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  size_t CountFiles() const {
    return static_cast<size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  fs::path folder_;
};

TEST_F(AtomicFiles, PiecesOfAnySizeAreThereInTheirOrderOnlyAfterCommit) {
  const fs::path path = folder_ / "table.csv";
  WriteFile(path, "old");
  std::string whole;
  {
    AtomicFile file(path);
    for (const size_t size : {1, 70000, 0, 3, 65535, 65536, 2}) {
      const std::string piece(size, static_cast<char>('a' + whole.size() % 26));
      file.Write(piece);
      whole += piece;
    }
    EXPECT_EQ(ReadFile(path), "old");
    file.Commit();
  }
  EXPECT_TRUE(ReadFile(path) == whole);
  EXPECT_EQ(CountFiles(), 1u);
}

TEST_F(AtomicFiles, NothingIsLeftWithoutCommit) {
  { AtomicFile(folder_ / "table.csv").Write("half"); }
  EXPECT_EQ(CountFiles(), 0u);
}

// Killed while it wrote, its parent gone or slow: nobody has asked about its end yet.
TEST_F(AtomicFiles, WhatAnEndedProcessLeftIsRemovedAlsoBeforeItsParentAsks) {
  const fs::path path = folder_ / "table.csv";
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    new AtomicFile(path);  // as after a kill, nothing tidies up
    ::_exit(0);
  }
  siginfo_t ended{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT), 0);
  ASSERT_EQ(CountFiles(), 1u) << "the part of the process that has ended";
  ASSERT_EQ(::kill(child, 0), 0) << "its number is still its own";
  {
    AtomicFile file(path);
    file.Commit();
  }
  EXPECT_EQ(CountFiles(), 1u);
  EXPECT_TRUE(fs::exists(path));
  ::waitpid(child, nullptr, 0);
}

TEST_F(AtomicFiles, AMissingFolderIsNamed) {
  try {
    AtomicFile file(folder_ / "none" / "table.csv");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kIo);
    EXPECT_NE(std::string(e.what()).find("cannot create"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace graspbench
