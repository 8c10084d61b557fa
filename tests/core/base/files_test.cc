#include "core/base/files.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/error.h"

namespace graspbench {
namespace {

const std::filesystem::path kTemporary = testing::TempDir();

TEST(Files, WriteThenReadGivesTheSameBytes) {
  const std::string bytes("a\0b\r\n\xff", 6);
  WriteFileAtomically(kTemporary / "bytes", bytes);
  EXPECT_EQ(ReadFile(kTemporary / "bytes"), bytes);
}

TEST(Files, AFileWrittenWithoutWaitingIsReplacedWhole) {
  const std::filesystem::path path = kTemporary / "quick";
  WriteFile(path, "a longer text");
  WriteFile(path, "short");
  EXPECT_EQ(ReadFile(path), "short");
  EXPECT_NO_THROW(SyncFileSystem(kTemporary));
}

TEST(Files, APartOfAKilledProcessIsRemovedAndThatOfALivingOneIsNot) {
  const pid_t dead = ::fork();
  if (dead == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(dead, nullptr, 0), dead);
  const std::string path = (kTemporary / "results").string();
  const std::string left = path + ".part" + std::to_string(dead);
  const std::string busy = path + ".part" + std::to_string(::getppid());
  const std::string other = path + ".partial";
  for (const std::string& file : {left, busy, other}) WriteFile(file, "half");
  WriteFileAtomically(path, "whole");
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_TRUE(std::filesystem::exists(busy));
  EXPECT_TRUE(std::filesystem::exists(other));
}

TEST(Files, AMissingFileIsNamed) {
  try {
    ReadFile("no/such/file");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kNotFound);
    EXPECT_STREQ(e.what(), "no file \"no/such/file\"");
  }
}

TEST(Files, AFolderIsNotAFile) { EXPECT_THROW(ReadFile(kTemporary), Error); }

TEST(Files, AnUnwritablePlaceGivesTheSystemsReason) {
  for (const auto write : {WriteFile, WriteFileAtomically}) {
    try {
      write("/proc/none/file", "x");
      FAIL();
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kIo);
      EXPECT_NE(std::string(e.what()).find("No such file"), std::string::npos) << e.what();
    }
  }
}

TEST(Files, MakesAndSyncsFolders) {
  MakeFolder(kTemporary / "a" / "b");
  MakeFolder(kTemporary / "a" / "b");
  SyncFolder(kTemporary / "a");
  EXPECT_TRUE(std::filesystem::is_directory(kTemporary / "a" / "b"));
  try {
    SyncFolder(kTemporary / "a" / "none");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kIo);
    EXPECT_NE(std::string(e.what()).find("No such file"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace graspbench
