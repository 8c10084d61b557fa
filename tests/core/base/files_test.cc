#include "core/base/files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

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

TEST(Files, DevicesAndPipesAreNoFiles) {
  const std::filesystem::path pipe = kTemporary / "pipe";
  std::filesystem::remove(pipe);
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& path : {pipe.string(), std::string("/dev/zero")}) {
    try {
      ReadFile(path);
      FAIL();
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kIo);
      EXPECT_EQ(std::string(e.what()),
                "\"" + path + "\" is a device, a pipe or a socket; a file was expected");
    }
  }
}

// Without a home the cache must not lie where anybody could have prepared it.
TEST(Files, TheCacheHasAHome) {
  const auto with = [](const char* cache, const char* home) {
    ::setenv("XDG_CACHE_HOME", cache, 1);
    ::setenv("HOME", home, 1);
    return FindCacheRoot().string();
  };
  EXPECT_EQ(with("/somewhere", "/home/me"), "/somewhere/graspbench");
  EXPECT_EQ(with("", "/home/me"), "/home/me/.cache/graspbench");
  EXPECT_EQ(with("", ""),
            (std::filesystem::temp_directory_path() / ("graspbench-" + std::to_string(::geteuid())))
                .string());
}

TEST(Files, PrivateFoldersAreTheirOwnersAlone) {
  const std::filesystem::path folder = kTemporary / "private" / "inner";
  MakePrivateFolder(folder);
  EXPECT_TRUE(IsPrivateFolder(folder));
  EXPECT_EQ(std::filesystem::status(folder).permissions(), std::filesystem::perms::owner_all);
  std::filesystem::permissions(folder, std::filesystem::perms::group_write,
                               std::filesystem::perm_options::add);
  EXPECT_FALSE(IsPrivateFolder(folder));
  MakePrivateFolder(folder);
  EXPECT_TRUE(IsPrivateFolder(folder));

  WriteFile(folder / "file", "");
  EXPECT_FALSE(IsPrivateFolder(folder / "file"));
  EXPECT_FALSE(IsPrivateFolder(folder / "none"));
  EXPECT_THROW(MakePrivateFolder(folder / "file"), Error);
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
