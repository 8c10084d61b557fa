#include "core/base/files/files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "core/base/error.h"

namespace graspbench {
namespace {

std::filesystem::path Temporary() { return testing::TempDir(); }

TEST(Files, WriteThenReadGivesTheSameBytes) {
  const std::string bytes("a\0b\r\n\xff", 6);
  WriteFileAtomically(Temporary() / "bytes", bytes);
  EXPECT_EQ(ReadFile(Temporary() / "bytes"), bytes);
}

TEST(Files, AFileWrittenWithoutWaitingIsReplacedWhole) {
  const std::filesystem::path path = Temporary() / "quick";
  WriteFile(path, "a longer text");
  WriteFile(path, "short");
  EXPECT_EQ(ReadFile(path), "short");
  EXPECT_NO_THROW(SyncFileSystem(Temporary()));
}

TEST(Files, APartOfAKilledProcessIsRemovedAndThatOfALivingOneIsNot) {
  const std::filesystem::path folder = Temporary() / "parts";
  std::filesystem::remove_all(folder);
  MakeFolder(folder);
  const std::string path = (folder / "results").string();
  const pid_t dead = ::fork();
  if (dead == 0) {  // the system kills it in the middle of the file
    const struct rlimit one_byte = {1, 1};
    ::setrlimit(RLIMIT_FSIZE, &one_byte);
    WriteFileAtomically(path, "more than a byte");
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(dead, &status, 0), dead);
  ASSERT_TRUE(WIFSIGNALED(status));
  const std::string left = std::filesystem::directory_iterator(folder)->path().string();
  const std::string id = ".part" + std::to_string(dead);
  ASSERT_NE(left.find(id), std::string::npos) << left;
  const std::string realm = left.substr(left.find(id) + id.size());

  const std::string busy = path + ".part" + std::to_string(::getppid()) + realm;
  const std::string elsewhere = path + id + "-00000000";
  const std::string other = path + ".partial";
  for (const std::string& file : {busy, elsewhere, other}) WriteFile(file, "half");
  WriteFileAtomically(path, "whole");
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_TRUE(std::filesystem::exists(busy));
  EXPECT_TRUE(std::filesystem::exists(elsewhere));
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

TEST(Files, AFolderIsNotAFile) { EXPECT_THROW(ReadFile(Temporary()), Error); }

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
  const std::filesystem::path pipe = Temporary() / "pipe";
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
  EXPECT_EQ(with("relative", "/home/me"), "/home/me/.cache/graspbench");
  const std::filesystem::path own =
      std::filesystem::temp_directory_path() / ("graspbench-" + std::to_string(::geteuid()));
  EXPECT_EQ(with("", ""), own.string());
  EXPECT_TRUE(IsPrivateFolder(own));
}

TEST(Files, ACacheBehindALinkIsNotUsed) {
  const std::filesystem::path place = Temporary() / "cache_place";
  std::filesystem::create_directories(place / "of_somebody");
  std::filesystem::create_directory_symlink(place / "of_somebody",
                                            place / ("graspbench-" + std::to_string(::geteuid())));
  ::setenv("TMPDIR", place.c_str(), 1);
  ::setenv("XDG_CACHE_HOME", "", 1);
  ::setenv("HOME", "", 1);
  EXPECT_EQ(FindCacheRoot(), "/dev/null/graspbench");
  ::unsetenv("TMPDIR");
  EXPECT_TRUE(std::filesystem::is_empty(place / "of_somebody"));
}

TEST(Files, PrivateFoldersAreTheirOwnersAlone) {
  const std::filesystem::path folder = Temporary() / "private" / "inner";
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
  MakeFolder(Temporary() / "a" / "b");
  MakeFolder(Temporary() / "a" / "b");
  SyncFolder(Temporary() / "a");
  EXPECT_TRUE(std::filesystem::is_directory(Temporary() / "a" / "b"));
  try {
    SyncFolder(Temporary() / "a" / "none");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kIo);
    EXPECT_NE(std::string(e.what()).find("No such file"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace graspbench
